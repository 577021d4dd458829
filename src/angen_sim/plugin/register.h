#pragma once

// Included by the .cpp of a plug-in library: all that it may use.
#include "plugin/outputs.h"
#include "plugin/plugin.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
