#pragma once
#include <string>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include "sweep/node/engine.hpp"
#include "sweep/results.hpp"

namespace coop::sweep {

/// A sweep of three runs in a folder of its own, none of them made.
class SmallSweep {
 public:
  SmallSweep() {
    sweep.config.launch = "a.yaml";
    sweep.config.seeds = 3;
    sweep.folder = folder_.path() / "results";
    sweep.inputs = {{"program dwa", "1"}};
    runs = plan_runs(sweep.config);
    std::filesystem::create_directories(sweep.folder);
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return folder_.path() / name;
  }
  [[nodiscard]] std::string result_of(const Run& run, bool success) const {
    return to_json({success, success ? "" : "died", 1.0, run.identity(sweep.config)});
  }
  void leave_result(const Run& run, bool success = true) const {
    write_file_atomically(result_file(sweep.folder, run), result_of(run, success));
  }

  Sweep sweep;
  std::vector<Run> runs;

 private:
  test::TemporaryFolder folder_;
};

}  // namespace coop::sweep
