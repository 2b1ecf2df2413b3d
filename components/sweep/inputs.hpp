#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/places.hpp"
#include "sweep/sweep_config.hpp"

namespace coop::sweep {

/// What decides the results of a sweep, each with the hash of its content: parts of the sweep file
/// ("sweep: grid"), files, and programs ("program dwa").
using Inputs = std::map<std::string, std::string>;

/// Names in the launch file and in the sweep's settings are followed: every word that names a file
/// (from the folder of the file it stands in, from `share`, or from here) is an input, and so is
/// what that file names in turn; every word that names a program brings the program and its
/// configuration file. So an input too many is possible (a word in a text that happens to name a
/// file), one too few only where a name is put together at run time. All of config/robot is an
/// input: programs have the name of the robot's description as their default. Not: system
/// libraries, and what only the report needs (title, figures, time limit, number of seeds of a
/// single point, so that a sweep of one point can be made longer).
[[nodiscard]] Inputs find_inputs(const SweepConfig& config, const Places& places);

/// One line each, and back. Throws std::runtime_error for a text that is none.
[[nodiscard]] std::string to_text(const Inputs& inputs);
[[nodiscard]] Inputs inputs_from_text(std::string_view text);

/// Names of the inputs that changed, came, or went.
[[nodiscard]] std::vector<std::string> differences(const Inputs& before, const Inputs& after);
/// The same for people, "config/dwa.yaml, program dwa and 3 more"; empty where nothing differs.
[[nodiscard]] std::string shown_differences(const Inputs& before, const Inputs& after);

}  // namespace coop::sweep
