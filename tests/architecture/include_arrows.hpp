#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "architecture/source_tree.hpp"

namespace coop::architecture {

/// Part of the house a file belongs to: "core", "core/config", "dwa", "dwa/node", "runtime",
/// "conversions", "launcher", "tests" or empty (no C++ part).
[[nodiscard]] std::string part_of_file(std::string_view path);

/// What an include refers to: a part of the house, or "idl", "Fast DDS", "yaml-cpp", "OpenCV",
/// "urdfdom", "Eigen", "spdlog"; empty for what everybody may use (standard library, system).
[[nodiscard]] std::string part_of_include(std::string_view include);

/// Whether a file of part `from` may include `to`: the table of the design page.
[[nodiscard]] bool may_include(std::string_view from, std::string_view to);

/// One line for each include that breaks the arrows: "components/dwa/critic.cpp:3: dwa may not
/// include amcl (amcl/x.hpp)".
[[nodiscard]] std::vector<std::string> broken_arrows(const std::vector<SourceFile>& files);

}  // namespace coop::architecture
