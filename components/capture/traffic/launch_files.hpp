#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

namespace coop::capture {

/// The files a launch is made of besides the launch file: configurations of the components it
/// names, and every map, world, robot or other file of which its text (or theirs) speaks, with the
/// pictures of maps. Where nobody names a robot, all there are in config/robot (one of them is the
/// default). Names are looked up as they are and below `share`. Each once, in the order
/// found.
[[nodiscard]] std::vector<std::filesystem::path> files_of_launch(
    std::string_view launch_text, const std::filesystem::path& share);

/// "application/yaml", "application/xml", ...
[[nodiscard]] std::string_view media_type_of(const std::filesystem::path& file);

}  // namespace coop::capture
