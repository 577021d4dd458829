#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "ros/channel.h"

/// What cameras saw, as messages in the optical frame (REP 103: z ahead, x right, y down).
namespace angen::node {

/// `image` as rgb8, `depth` as 32FC1 in m.
void fill_image(const Reading& reading, const Label& label, sensor_msgs::Image& message);

/// A pinhole without distortion; pixel centers have whole coordinates.
void fill_camera_info(const Reading& reading, const Label& label, sensor_msgs::CameraInfo& message);

}  // namespace angen::node
