#pragma once
#include <map>
#include <string>
#include <vector>

#include "system/containers/container_engine.hpp"

namespace coop::test {

/// A project of docker-compose, taken down with its volumes at the object's end.
class Composition {
 public:
  Composition(std::string project, std::vector<std::filesystem::path> files);
  ~Composition();
  Composition(const Composition&) = delete;
  Composition& operator=(const Composition&) = delete;

  /// docker-compose with the project's files; throws std::runtime_error where it fails.
  std::string compose(const std::vector<std::string>& arguments,
                      milliseconds limit = std::chrono::minutes(3)) const;
  [[nodiscard]] std::vector<std::string> services() const;
  /// What `docker inspect --format` says of a service's container; empty while there is none.
  [[nodiscard]] std::string inspect(const std::string& service, const std::string& format) const;
  /// Of each service: "Up 3 seconds (healthy)", "Restarting (1) ..."
  [[nodiscard]] std::map<std::string, std::string> states() const;
  bool wait_until_healthy(const std::vector<std::string>& services,
                          milliseconds limit = std::chrono::minutes(2)) const;
  /// SIGKILL to the component itself, below the container's init; false where it does not run.
  [[nodiscard]] bool kill_program(const std::string& service) const;
  [[nodiscard]] int restarts(const std::string& service) const;
  /// `docker ...` on a service's container, named last.
  void docker(const std::string& verb, const std::string& service) const;
  [[nodiscard]] std::string logs() const;

 private:
  [[nodiscard]] std::string container(const std::string& service) const;

  std::string project_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace coop::test
