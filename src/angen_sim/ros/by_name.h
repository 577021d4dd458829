#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <algorithm>
#include <boost/array.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "core/lists.h"
#include "plugin/reading.h"
#include "ros/channel.h"

/// Messages whose fields have the names of their reading's.
namespace angen::node {

/// The names of a message's fields, in their order, as its definition has them.
std::vector<std::string> field_names(const std::string& definition);

/// Sets the fields of a message, which roscpp passes to it like to a stream: all, in their order.
class FieldsByName {
 public:
  /// `optional`: fields that stay as they are if the reading does not have them.
  FieldsByName(const Reading& reading, const Label& label, const std::vector<std::string>& names,
               const std::vector<std::string>& optional)
      : reading_(reading), label_(label), names_(names), optional_(optional) {}

  template <class T>
  void next(T& field) {
    const std::string& name = names_.at(at_++);
    const bool may_lack = is_in(name, optional_);
    if (!may_lack || reading_.find(name) != nullptr) set(name, field);
  }

 private:
  template <class T>
  using OfNumber = std::enable_if_t<std::is_arithmetic_v<T>>;
  template <class T>
  using OfMessage = std::enable_if_t<ros::message_traits::IsMessage<T>::value>;

  template <class T>
  OfMessage<T> set(const std::string&, T&) {}  // the header, or a part that the caller fills in
  template <class T>
  OfNumber<T> set(const std::string& name, T& field) {
    if (const auto* flag = reading_.get_if<bool>(name)) {
      field = static_cast<T>(*flag);
    } else if (const auto* choice = reading_.get_if<Choice>(name)) {
      field = static_cast<T>(choice->value);
    } else if (const auto* whole = reading_.get_if<std::int64_t>(name)) {
      field = static_cast<T>(*whole);
    } else {
      field = of_number<T>(reading_.get<double>(name));
    }
  }
  /// A whole number within the limits of its type; NaN is 0.
  template <class T>
  static T of_number(double value) {
    if constexpr (std::is_floating_point_v<T>) return static_cast<T>(value);
    if (std::isnan(value)) return T{};
    using Limits = std::numeric_limits<T>;
    if (value <= static_cast<double>(Limits::min())) return Limits::min();
    if (value >= static_cast<double>(Limits::max())) return Limits::max();
    return static_cast<T>(value);
  }
  template <class T>
  OfNumber<T> set(const std::string& name, std::vector<T>& field) {
    const auto values = reading_.get<std::vector<double>>(name);
    field.assign(values.begin(), values.end());
  }
  template <class T, std::size_t N>
  OfNumber<T> set(const std::string& name, boost::array<T, N>& field) {
    const auto values = reading_.get<std::vector<double>>(name);
    std::copy_n(values.begin(), std::min(values.size(), N), field.begin());
  }
  void set(const std::string& name, std::string& field) {
    field = name == "name" ? label_.name : reading_.get<std::string>(name);
  }
  void set(const std::string& name, std::vector<std::string>& field) {
    field = reading_.get<std::vector<std::string>>(name);
  }

  const Reading& reading_;
  const Label& label_;
  const std::vector<std::string>& names_;
  const std::vector<std::string>& optional_;
  std::size_t at_ = 0;
};

/// Fills in a message's fields from those of the reading with the same names, a `name` from the
/// label. Fields that are messages, and `optional` ones that the reading lacks, stay as they are.
template <class Message>
void fill_by_name(const Reading& reading, const Label& label, Message& message,
                  const std::vector<std::string>& optional) {
  static const std::vector<std::string> names =
      field_names(ros::message_traits::definition<Message>());
  FieldsByName fields(reading, label, names, optional);
  ros::serialization::Serializer<Message>::template allInOne<FieldsByName, Message&>(fields,
                                                                                     message);
}
template <class Message>
void fill_by_name(const Reading& reading, const Label& label, Message& message) {
  fill_by_name(reading, label, message, {});
}

}  // namespace angen::node
