"""rviz, with views of the world at hand."""
