#pragma once
#include <string>
#include <vector>

#include "capture/traffic/play_list.hpp"
#include "core/config/fields.hpp"

namespace coop::capture {

struct PlayConfig {
  std::string file;   ///< a capture, or a folder of captures
  double rate = 1.0;  ///< seconds of the capture a second; 0: as fast as possible
  bool loop = false;
  double start = 0.0;     ///< s
  double duration = 0.0;  ///< s; 0: to the end
  std::vector<std::string> topics;
  std::vector<std::string> exclude;
  std::vector<std::string> without;
  std::vector<std::string> remap;
  bool clock = true;
  double clock_period = 0.01;  ///< s of the capture
  double wait = 5.0;           ///< s
  std::vector<std::string> readers;
  bool paused = false;
  bool keyboard = false;

  void describe(config::Fields& fields);
  void validate() const;
  [[nodiscard]] PlaySelection selection() const;
};

}  // namespace coop::capture
