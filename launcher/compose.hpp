#pragma once
#include <filesystem>
#include <string>

#include "core/places.hpp"
#include "launcher/plan.hpp"

namespace coop::launcher {

/// Where things lie in the container image (docker/Dockerfile).
struct ImagePlaces {
  std::filesystem::path programs = "/usr/lib/coop";
  std::filesystem::path share = "/usr/share/coop";
  std::filesystem::path run = "/var/lib/coop";  ///< journals and results, a volume
};

/// The plan as a Compose file, for docker-compose 1.29 and `docker compose` alike: a service a
/// component on one bridge network, started and stopped in the same order, asked for its health,
/// started again as the launch file says. `plan` was made for the run folder ImagePlaces::run;
/// names of files below `places` become those in the image. `title` names the launch file in a
/// comment. Throws config::Error for a file that the image cannot have.
[[nodiscard]] std::string compose_file(const Plan& plan, const Places& places,
                                       const std::string& title);

/// What is laid over it. "host": the host's network and shared memory. "security": each component's
/// own keys. "hardware": devices of the drivers. Throws config::Error for another name.
[[nodiscard]] std::string compose_override(const Plan& plan, const std::string& name,
                                           const std::string& title);

}  // namespace coop::launcher
