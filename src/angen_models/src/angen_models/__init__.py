"""Writes Angen's models, meshes and worlds, and has the numbers of its building."""
