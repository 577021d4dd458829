#include "record/fingerprint.h"

#include <cstdio>
#include <cstring>
#include <type_traits>
#include <utility>

#include "core/random.h"

namespace angen::record {

namespace {

// Whole words instead of FNV's bytes: a snapshot of a building has some 20 kB.
class Mixer {
 public:
  explicit Mixer(std::uint64_t hash) : hash_(hash) {}

  template <class T>
  std::enable_if_t<std::is_integral_v<T>> add(T value) {
    hash_ = (hash_ ^ static_cast<std::uint64_t>(value)) * 0x100000001b3ULL;
    hash_ ^= hash_ >> 29;
  }
  void add(double value) {
    std::uint64_t bits = 0;
    static_assert(sizeof bits == sizeof value);
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }
  void add(const std::string& text) { add(hash_bytes(text)); }
  void add(const Choice& choice) { add(std::string(choice.name)); }
  void add(float value) { add(static_cast<double>(value)); }
  template <class T>
  void add(const ImageArray<T>& grid) {
    add(grid.height);
    add(grid.width);
    add(grid.channels);
    if (grid.values) add(*grid.values);
  }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const Pose& pose) {
    add(pose.position);
    for (int i = 0; i < 4; ++i) add(pose.rotation.coeffs()[i]);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
  }
  void add(const Reading& reading) {
    add(reading.kind);
    add(reading.stamp);
    for (const auto& [name, value] : reading.fields) {
      add(name);
      std::visit([this](const auto& v) { add(v); }, value);
    }
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_;
};

}  // namespace

void RunFingerprint::add(const sim::Snapshot& snapshot) {
  Mixer mixer(hash_);
  bool changed = false;
  const auto add = [&](const auto&... values) {
    if (!std::exchange(changed, true)) mixer.add(snapshot.tick);
    (mixer.add(values), ...);
  };
  if (snapshot.structure != structure_) {
    structure_ = snapshot.structure;
    for (const auto& model : structure_->models) add(model->name);
    for (std::size_t i = 0; i < snapshot.link_poses.size(); ++i) add(snapshot.link_poses[i]);
    for (std::size_t i = 0; i < snapshot.joint_positions.size(); ++i) {
      add(snapshot.joint_positions[i]);
    }
  }
  // A joint's position follows from its links' poses, so these say all that moved.
  for (const std::uint32_t i : snapshot.moved_links) add(i, snapshot.link_poses[i]);
  if (snapshot.light_levels != light_levels_) {
    if (light_levels_ == nullptr || *snapshot.light_levels != *light_levels_) {
      add(*snapshot.light_levels);
    }
    light_levels_ = snapshot.light_levels;
  }
  for (const std::uint32_t i : snapshot.new_readings) {
    const std::shared_ptr<const Reading>& reading = snapshot.sensors[i].reading;
    if (reading->stamp == snapshot.time && !structure_->sensors[i].on_demand()) add(i, *reading);
  }
  for (const std::uint32_t i : snapshot.new_states) add(i, *snapshot.devices[i]);
  for (const sim::Event& event : snapshot.events) {
    add(event.stamp, event.source, event.kind, event.event);
    if (event.event != "warning" && event.event != "rejected") add(event.detail);
  }
  hash_ = mixer.hash();
}

void Fingerprint::add(const sim::Snapshot& snapshot) {
  run_.add(snapshot);
  Mixer mixer(hash_);
  mixer.add(run_.value());
  mixer.add(snapshot.tick);
  mixer.add(snapshot.time);
  mixer.add(snapshot.paused);
  for (const std::uint32_t i : snapshot.new_readings) {
    mixer.add(i);
    // Lazy readings follow from the one before, the seed and the time.
    const std::shared_ptr<const Reading>& reading = snapshot.sensors[i].reading;
    const bool on_demand = snapshot.structure->sensors[i].on_demand();
    if (reading->stamp == snapshot.time && on_demand) mixer.add(*reading);
  }
  for (const sim::Event& event : snapshot.events) mixer.add(event.detail);
  hash_ = mixer.hash();
}

std::string fingerprint_text(std::uint64_t hash) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

}  // namespace angen::record
