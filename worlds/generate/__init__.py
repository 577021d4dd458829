"""Generators of Angen's models, meshes and worlds."""
