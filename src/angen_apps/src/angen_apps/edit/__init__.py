"""angen edit: homes drawn in a browser."""
