#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/fault.h"
#include "sim/snapshot.h"

namespace angen::sim {

/// The transmission of readings and events of sensors into a snapshot, with its faults.
/// Sensors, devices and the simulation itself are not affected: only the snapshot is changed. The
/// effect of a fault is an event of the kind "fault".
class Faults {
 public:
  explicit Faults(std::uint64_t seed) : seed_(seed) {}

  /// There are other sensors. New ones have the faults that their SDF names.
  void follow(std::shared_ptr<const Structure> structure, Nanoseconds now);
  /// Gives faults to the sensors whose name, or KIND/NAME, matches a pattern as of file names;
  /// "Off" takes all from them. Throws Error if none matches.
  void give(const std::string& pattern, const std::string& text, Nanoseconds now);
  /// Back to those that SDF names.
  void reset();

  /// Changes the readings of sensors with faults in a snapshot.
  void pass(Snapshot& made);

  /// A sensor that is knocked out of its place.
  struct Move {
    std::string kind;
    std::string name;
    Pose by;
  };
  /// Moves that are due, once each.
  std::vector<Move> moves(Nanoseconds now);

  /// When something comes that no sensor sends.
  Nanoseconds next() const;

 private:
  struct Active {
    Fault fault;
    Nanoseconds since = 0;
    std::uint64_t key = 0;         // key of its random numbers
    Nanoseconds alarm = kForever;  // the next false one
    Nanoseconds alarm_end = 0;     // end of the present one, 0: there is none
    std::int64_t alarms = 0;
    bool done = false;   // it was moved
    bool begun = false;  // it was said
  };
  struct Message {
    std::shared_ptr<const Reading> reading;
    Nanoseconds stamp = 0;
    bool sent = false;  // the reading is published, instead of only being known
    std::vector<Event> events;
  };
  struct Channel {
    std::size_t index = 0;  // in Structure::sensors
    std::vector<Active> faults;
    std::shared_ptr<const Reading> clean;  // the latest that the sensor has made
    Nanoseconds stamp = -1;                // its
    Message shown;
    std::vector<std::pair<Nanoseconds, Message>> late;
    int given = 0;  // faults, for their keys
  };

  std::size_t add(const SensorEntry& entry, const std::vector<Fault>& faults, Nanoseconds now);
  std::vector<Message> messages(Channel& channel, Message message, const Snapshot& now);
  bool passes(Active& active, Channel& channel, Message& message, const Snapshot& now,
              Nanoseconds& delay, bool& twice);
  void alarm(Active& active, Channel& channel, const Snapshot& now, std::vector<Message>& found);
  void draw_alarm(Active& active, Nanoseconds now) const;
  void deliver(Channel& channel, Message message, Snapshot& made);
  void note(const Channel& channel, const Active& active, Nanoseconds now,
            const std::string& detail);

  std::uint64_t seed_;
  std::shared_ptr<const Structure> structure_;
  std::map<std::string, Channel> channels_;  // by KIND/NAME
  std::set<std::string> known_;              // whose SDF has been read
  std::vector<Event> notes_;
};

}  // namespace angen::sim
