#include "ros/readings.h"

#include <algorithm>
#include <type_traits>

#include "ros/convert.h"

namespace angen::node {

void fill(const Reading& reading, const Label&, angen_msgs::PirMsg& message) {
  message.motion = reading.get<bool>("motion");
  message.difference = reading.get<double>("difference");
  message.threshold = reading.get<double>("threshold");
  message.signal = reading.get<double>("signal");
  message.signal_threshold = reading.get<double>("signal_threshold");
}

void fill(const Reading& reading, const Label&, angen_msgs::SwitchMsg& message) {
  message.closed = reading.get<bool>("closed");
  message.changed = reading.get<bool>("changed");
  const auto ranges = reading.get<std::vector<double>>("ranges");
  std::copy_n(ranges.begin(), std::min(ranges.size(), message.ranges.size()),
              message.ranges.begin());
  message.difference = reading.get<double>("difference");
  message.threshold = reading.get<double>("threshold");
}

void fill(const Reading& reading, const Label&, angen_msgs::LightSensMsg& message) {
  message.illuminance = reading.get<double>("illuminance");
  message.r = static_cast<float>(reading.get<double>("r"));
  message.g = static_cast<float>(reading.get<double>("g"));
  message.b = static_cast<float>(reading.get<double>("b"));
}

void fill(const Reading& reading, const Label&, sensor_msgs::LaserScan& message) {
  const auto number = [&](const char* name) {
    return static_cast<float>(reading.get<double>(name));
  };
  message.angle_min = number("angle_min");
  message.angle_max = number("angle_max");
  message.angle_increment = number("angle_increment");
  message.scan_time = number("scan_time");
  message.range_min = number("range_min");
  message.range_max = number("range_max");
  const auto ranges = reading.get<std::vector<double>>("ranges");
  message.ranges.assign(ranges.begin(), ranges.end());
}

void fill(const Reading& reading, const Label&, sensor_msgs::Range& message) {
  const auto number = [&](const char* name) {
    return static_cast<float>(reading.get<double>(name));
  };
  message.radiation_type =
      reading.get<bool>("infrared") ? sensor_msgs::Range::INFRARED : sensor_msgs::Range::ULTRASOUND;
  message.field_of_view = number("field_of_view");
  message.min_range = number("min_range");
  message.max_range = number("max_range");
  message.range = number("range");
}

void fill(const Reading& reading, const Label&, angen_msgs::PressureMsg& message) {
  message.pressed = reading.get<bool>("pressed");
  message.load = reading.get<double>("load");
  message.threshold = reading.get<double>("threshold");
}

void fill(const Reading& reading, const Label&, angen_msgs::ReedMsg& message) {
  message.closed = reading.get<bool>("closed");
  message.distance = reading.get<double>("distance");
  message.operate_distance = reading.get<double>("operate_distance");
  message.release_distance = reading.get<double>("release_distance");
}

void fill(const Reading& reading, const Label&, angen_msgs::RfidMsg& message) {
  message.ids = reading.get<std::vector<std::string>>("ids");
  message.distances = reading.get<std::vector<double>>("distances");
}

void fill(const Reading& reading, const Label&, angen_msgs::PlugMsg& message) {
  message.load = reading.get<std::string>("load");
  message.connected = reading.get<bool>("connected");
  message.power = reading.get<double>("power");
  message.energy = reading.get<double>("energy");
}

void fill(const Reading& reading, const Label&, sensor_msgs::Temperature& message) {
  message.temperature = reading.get<double>("temperature");
  message.variance = reading.get<double>("variance");
}

void fill(const Reading& reading, const Label&, sensor_msgs::RelativeHumidity& message) {
  message.relative_humidity = reading.get<double>("humidity") / 100.0;
  message.variance = reading.get<double>("variance") / 1e4;
}

void fill(const Reading& reading, const Label&, gazebo_msgs::ContactsState& message) {
  message.header.frame_id = "world";
  const auto first = reading.get<std::vector<std::string>>("collision1");
  const auto second = reading.get<std::vector<std::string>>("collision2");
  const auto counts = reading.get<std::vector<double>>("counts");
  const auto positions = reading.get<std::vector<double>>("positions");
  const auto normals = reading.get<std::vector<double>>("normals");
  const auto depths = reading.get<std::vector<double>>("depths");
  const auto forces = reading.get<std::vector<double>>("forces");
  const std::size_t points =
      std::min({positions.size() / 3, normals.size() / 3, depths.size(), forces.size() / 3});
  std::size_t next = 0;
  for (std::size_t i = 0; i < std::min({first.size(), second.size(), counts.size()}); ++i) {
    gazebo_msgs::ContactState state;
    state.collision1_name = first[i];
    state.collision2_name = second[i];
    state.info = first[i] + " touches " + second[i];
    Vec3 force_sum = Vec3::Zero();
    Vec3 torque_sum = Vec3::Zero();
    for (auto left = static_cast<std::size_t>(counts[i]); left > 0 && next < points;
         --left, ++next) {
      const Vec3 position = Vec3::Map(&positions[3 * next]);
      const Vec3 force = Vec3::Map(&forces[3 * next]);
      const Vec3 torque = position.cross(force);
      geometry_msgs::Wrench wrench;
      wrench.force = to_vector(force);
      wrench.torque = to_vector(torque);
      state.wrenches.push_back(wrench);
      state.contact_positions.push_back(to_vector(position));
      state.contact_normals.push_back(to_vector(Vec3::Map(&normals[3 * next])));
      state.depths.push_back(depths[next]);
      force_sum += force;
      torque_sum += torque;
    }
    state.total_wrench.force = to_vector(force_sum);
    state.total_wrench.torque = to_vector(torque_sum);
    message.states.push_back(std::move(state));
  }
}

void fill(const Reading& reading, const Label& label, angen_msgs::Reading& message) {
  message.name = label.name;
  message.kind = reading.kind;
  const auto number = [&](const std::string& name, double value) {
    message.names.push_back(name);
    message.values.push_back(value);
  };
  const auto text = [&](const std::string& name, const std::string& value) {
    message.text_names.push_back(name);
    message.texts.push_back(value);
  };
  const auto each = [](const std::string& name, const auto& values, const auto& add) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      add(name + "[" + std::to_string(i) + "]", values[i]);
    }
  };
  for (const auto& [name, value] : reading.fields) {
    std::visit(
        [&, &field = name](const auto& held) {
          using T = std::decay_t<decltype(held)>;
          if constexpr (std::is_arithmetic_v<T>) {
            number(field, static_cast<double>(held));
          } else if constexpr (std::is_same_v<T, std::string>) {
            text(field, held);
          } else if constexpr (std::is_same_v<T, std::vector<double>>) {
            each(field, held, number);
          } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
            each(field, held, text);
          }
        },
        value);
  }
}

}  // namespace angen::node
