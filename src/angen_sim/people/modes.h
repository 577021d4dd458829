#pragma once

namespace angen::people {

/// What others see of a person, and the events of its changes.
enum class Mode { kStanding, kWalking, kBlocked };
inline constexpr const char* kModes[] = {"STANDING", "WALKING", "BLOCKED"};
inline constexpr const char* kModeEvents[] = {"stands", "walks", "blocked"};

constexpr double kAhead = 0.35;  // s: a person makes for where its path will be then

}  // namespace angen::people
