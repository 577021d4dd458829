#pragma once

namespace angen::people {

enum class Posture { kStand, kSit, kLie };
inline constexpr const char* kPostures[] = {"stand", "sit", "lie"};

/// What others see of a person, and the events of its changes.
enum class Mode { kStanding, kWalking, kBlocked, kSitting, kLying };
inline constexpr const char* kModes[] = {"STANDING", "WALKING", "BLOCKED", "SITTING", "LYING"};
inline constexpr const char* kModeEvents[] = {"stands", "walks", "blocked", "sits", "lies"};

constexpr double kAhead = 0.35;  // s: a person makes for where its path will be then

}  // namespace angen::people
