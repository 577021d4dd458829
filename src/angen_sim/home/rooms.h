#pragma once

#include <vector>

#include "home/survey.h"

namespace angen {

/// The rooms between walls of a world that names none; names and storeys are left to the caller.
std::vector<Room> guess_rooms(const HomeSurvey& survey);

}  // namespace angen
