#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "ros/bulk.h"
#include "ros/channel.h"

/// Images of cameras as messages in the optical frame (REP 103: z ahead, x right, y down).
namespace angen::node {

using BulkImage = Bulk<sensor_msgs::Image>;

/// `image` as rgb8, or mono8 with one channel.
void fill_image(const Reading& reading, const Label& label, BulkImage& message);

/// `depth` as 32FC1 in m, or as 16UC1 in mm where the reading says so.
void fill_depth(const Reading& reading, const Label& label, BulkImage& message);

/// A pinhole with the lens's distortion; pixel centers have whole coordinates.
void fill_camera_info(const Reading& reading, const Label& label, sensor_msgs::CameraInfo& message);

}  // namespace angen::node
