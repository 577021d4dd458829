#include <sensor_msgs/CameraInfo.h>

#include "ros/kinds/images.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

ANGEN_REGISTER_ROS_KIND({"camera"},
                        RosKindBuilder()
                            .message<BulkImage>(&fill_image, "image_raw", "imageTopicName")
                            .message<sensor_msgs::CameraInfo>(&fill_camera_info, "camera_info",
                                                              "cameraInfoTopicName")
                            .optical_frame());

}  // namespace
}  // namespace angen::node
