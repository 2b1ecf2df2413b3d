#pragma once
#include "core/search/grid_planner.hpp"
