#include "core/carmen/playback_position.hpp"

#include <cstring>
#include <type_traits>

namespace coop::carmen {
namespace {

struct Record {
  PlaybackPosition::Log log;
  PlaybackPosition::Mark mark;
};
static_assert(std::is_trivially_copyable_v<Record>);

}  // namespace

PlaybackPosition::PlaybackPosition(std::filesystem::path path, const Log& log)
    : path_(std::move(path)), log_(log) {
  const auto stored = StateJournal::newest(path_);
  if (stored && stored->size() == sizeof(Record)) {
    Record record;
    std::memcpy(&record, stored->data(), sizeof record);
    if (record.log == log_ && record.mark.taken <= log_.records) found_ = record.mark;
  }
  journal_ = std::make_unique<StateJournal>(path_, sizeof(Record));
}

void PlaybackPosition::write(const Mark& mark) {
  if (!journal_ || written_ == mark) return;
  const Record record{log_, mark};
  journal_->write({reinterpret_cast<const char*>(&record), sizeof record});
  written_ = mark;
}

void PlaybackPosition::forget() {
  journal_.reset();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace coop::carmen
