// libhector_gazebo_ros_gps.so
#include <cmath>

#include "plugin/registration.h"
#include "plugin/wiring.h"
#include "robots/base.h"

namespace angen::robots {

namespace {

// WGS 84
constexpr double kEquatorialRadius = 6378137.0;  // m
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kDegree = M_PI / 180.0;

}  // namespace

/// The receiver of hector_gazebo_plugins: x of the world is north and y west, turned by a heading.
class Gps : public Sensor {
 public:
  static Kind describe() {
    return Kind("gps", "Latitude, longitude and altitude of a link.")
        .rate(4.0)
        .on_demand()
        .number("latitude", "deg", "north")
        .shown(7)
        .number("longitude", "deg", "east")
        .shown(7)
        .number("altitude", "m", "above the ellipsoid")
        .shown(2)
        .numbers("velocity", "m/s", "north, west, up")
        .numbers("variances", "m^2", "of the position")
        .integer("status", "", "of sensor_msgs/NavSatStatus")
        .integer("service", "", "of sensor_msgs/NavSatStatus");
  }

  void configure(Params& params, Wiring& wiring) override {
    latitude_ =
        params.number("referenceLatitude", 49.9, "deg", "of the world's origin", {-89.9, 89.9});
    longitude_ =
        params.number("referenceLongitude", 8.9, "deg", "of the world's origin", {-360.0, 360.0});
    heading_ =
        kDegree * params.number("referenceHeading", 0.0, "deg",
                                "from north to the world's x axis, clockwise", {-360.0, 360.0});
    altitude_ = params.number("referenceAltitude", 0.0, "m", "of the world's origin");
    status_ = params.integer("status", 0, "", "of sensor_msgs/NavSatStatus", {-1.0, 2.0});
    service_ = params.integer("service", 1, "", "of sensor_msgs/NavSatStatus", {0.0, 15.0});
    error_ = three_numbers(params, "gaussianNoise", "m", "standard deviation of the position");
    velocity_error_ =
        three_numbers(params, "velocityGaussianNoise", "m/s", "standard deviation of the velocity");
    params.text("velocityTopicName", "fix_velocity", "of its velocity");
    params.text("frameId", "", "frame_id of its messages; none: bodyName");
    for (const char* path : {"offset", "drift", "driftFrequency", "scaleError", "velocityOffset",
                             "velocityDrift", "velocityDriftFrequency", "velocityScaleError"}) {
      params.text(path, "", "not used: its errors are those of the noise");
    }
    link_ = wiring.link("");
    find_radii();
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    const LinkView own = own_state(view, link_);
    const Eigen::AngleAxisd to_north(-heading_, Vec3::UnitZ());
    const Vec3 at = to_north * with_errors(own.pose.position, error_, rng);
    const Vec3 velocity = to_north * with_errors(own.linear_velocity, velocity_error_, rng);
    reading.set("latitude", latitude_ + at.x() / north_radius_ / kDegree);
    reading.set("longitude", longitude_ - at.y() / east_radius_ / kDegree);
    reading.set("altitude", altitude_ + at.z());
    reading.set("velocity", numbers(velocity));
    reading.set("variances", numbers(Vec3(error_.cwiseAbs2())));
    reading.set("status", status_);
    reading.set("service", service_);
  }

 private:
  // Radii of the ellipsoid along the meridian, and of the circle of latitude.
  void find_radii() {
    const double sine = std::sin(kDegree * latitude_);
    const double eccentricity2 = kFlattening * (2.0 - kFlattening);
    const double t = 1.0 / (1.0 - eccentricity2 * sine * sine);
    const double vertical = kEquatorialRadius * std::sqrt(t);
    north_radius_ = vertical * (1.0 - eccentricity2) * t;
    east_radius_ = vertical * std::cos(kDegree * latitude_);
  }

  LinkRef link_;
  double latitude_ = 0.0;                          // deg
  double longitude_ = 0.0;                         // deg
  double heading_ = 0.0;                           // rad
  double altitude_ = 0.0;                          // m
  double north_radius_ = 1.0, east_radius_ = 1.0;  // m
  int status_ = 0;
  int service_ = 1;
  Vec3 error_ = Vec3::Zero();           // m
  Vec3 velocity_error_ = Vec3::Zero();  // m/s
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::BodySensorPlugin<angen::robots::Gps>)
