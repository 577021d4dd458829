"""Interactive markers of rviz: devices that one clicks."""
