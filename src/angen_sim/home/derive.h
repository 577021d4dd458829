#pragma once

#include <string>
#include <vector>

#include "home/survey.h"

namespace angen {

/// A name with the storey's number instead of "{storey}".
std::string with_storey(std::string name, const std::string& number);

/// Doors, windows and openings with the rooms on their sides, and elevators with their landings, of
/// a home whose rooms and storeys are known.
void add_passages(const HomeSurvey& survey, Home& home);

/// The rooms between walls of a world that names none; names and storeys are left to the caller.
std::vector<Room> guess_rooms(const HomeSurvey& survey);

}  // namespace angen
