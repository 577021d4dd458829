#pragma once

#include <memory>
#include <mutex>
#include <string>
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

  desc::HomeParts parts;  // of the world
  desc::HomeSite site;
  std::vector<Standing> models;
  std::vector<Leaf> leaves;
  std::vector<Lift> lifts;
};

/// Something of a description that is missing, so that it was derived, or that contradicts itself.
struct HomeFinding {
  bool guessed = false;
  std::string text;
};

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
