#pragma once
#include <vector>

#include "demo/node/story.hpp"

namespace coop::demo {

/// The cleaning robot in the pens named, one after the other, each with a seed of its own (the
/// seed and up), then the report. Exit codes as run_story().
int run_cleaning(const StoryOptions& options, const std::vector<int>& pens);

}  // namespace coop::demo
