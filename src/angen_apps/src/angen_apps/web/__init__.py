"""angen web: the building in a browser."""
