#include "sweep/node/settled_inputs.hpp"

#include "core/atomic_file.hpp"
#include "core/config/error.hpp"
#include "sweep/results.hpp"

namespace coop::sweep {
namespace {

namespace fs = std::filesystem;

bool has_results(const fs::path& folder) {
  if (!fs::exists(folder / "runs")) return false;
  for (const auto& run : fs::directory_iterator(folder / "runs")) {
    const fs::path result = run.path() / "result.json";
    if (fs::exists(result) && result_from_json(read_file(result)).success) return true;
  }
  return false;
}

}  // namespace

void settle_inputs(const Sweep& sweep, bool is_task) {
  const fs::path file = sweep.folder / "inputs.txt";
  const bool is_known = fs::exists(file);
  if (is_task ? is_known : has_results(sweep.folder)) {
    const std::string changed =
        is_known ? shown_differences(inputs_from_text(read_file(file)), sweep.inputs) : "";
    if (is_known && changed.empty()) return;
    throw config::Error("the results in " + sweep.folder.string() + " are of other inputs (" +
                        (is_known ? "changed: " + changed : "inputs.txt is missing") +
                        "); --restart makes all of them anew, or name another folder with -o");
  }
  write_file_atomically(file, to_text(sweep.inputs));
}

}  // namespace coop::sweep
