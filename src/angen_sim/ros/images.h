#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include "ros/formats.h"

/// What cameras saw, as messages in the optical frame (REP 103: z ahead, x right, y down); the
/// caller fills the headers.
namespace angen::node {

/// `image` as rgb8, `depth` as 32FC1 in m.
void fill(const Reading& reading, const Label& label, sensor_msgs::Image& message);

/// A pinhole without distortion; pixel centres have whole coordinates.
void fill(const Reading& reading, const Label& label, sensor_msgs::CameraInfo& message);

/// `depth` as one point a pixel, x y z in m; NaN where nothing is.
void fill(const Reading& reading, const Label& label, sensor_msgs::PointCloud2& message);

}  // namespace angen::node
