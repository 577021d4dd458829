"""Checks of a home's data."""
