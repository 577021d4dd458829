"""The package gazebo_ros for launch files and scripts written for Gazebo, served by Angen."""
