#pragma once
#include "core/search/dijkstra.hpp"
