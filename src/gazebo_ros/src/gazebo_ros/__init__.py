"""What launch files and scripts written for Gazebo's gazebo_ros use, served by Angen."""
