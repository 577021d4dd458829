#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/home.h"
#include "desc/world.h"

namespace angen {

/// All that a home is derived from.
struct HomeSurvey {
  struct Standing {
    std::shared_ptr<const desc::Model> model;
    Pose pose;  // world
  };
  /// A door or window on a hinge.
  struct Leaf {
    std::size_t model = 0;  // in `models`
    std::string joint;
    std::string name;
    HomeDoor::Kind kind = HomeDoor::Kind::kDoor;
  };
  struct Lift {
    std::size_t model = 0;
    std::string joint;
    std::string name;
    std::vector<double> stops;  // m, positions of the joint
  };

  desc::HomeParts parts;  // parts of the world
  desc::HomeSite site;
  std::vector<Standing> models;
  std::vector<Leaf> leaves;
  std::vector<Lift> lifts;
  std::vector<Storey> storeys;  // result of storeys_of()
};

/// Something of a description that is missing, so that it was derived, or that contradicts itself.
struct HomeFinding {
  bool guessed = false;
  std::string text;
};

/// The rooms of parts in a frame, whose names and storeys are not known yet.
std::vector<Room> rooms_of(const desc::HomeParts& parts, const Pose& frame,
                           const std::string& model);
/// The storeys by elevation, as the world and these models describe them; or else by the floors of
/// the rooms that they describe; or else by floors on which walls or doors stand. None if there
/// are neither. Heights and names that are not given are left to derive_home().
std::vector<Storey> storeys_of(const desc::HomeParts& world,
                               const std::vector<std::pair<const desc::Model*, Pose>>& models);
Home derive_home(const HomeSurvey& survey);
std::vector<HomeFinding> check_home(const HomeSurvey& survey, const Home& home);

/// A home that is derived when it is first read. Any thread may do so.
class DerivedHome {
 public:
  explicit DerivedHome(HomeSurvey survey) : survey_(std::move(survey)) {}

  const Home& get() const;
  std::vector<HomeFinding> findings() const { return check_home(survey_, get()); }

 private:
  HomeSurvey survey_;
  mutable std::once_flag once_;
  mutable Home home_;
};

}  // namespace angen
