#include "core/carmen/playback_position.hpp"

#include <cstring>
#include <type_traits>

namespace coop::carmen {
namespace {

struct Entry {
  PlaybackPosition::Log log;
  PlaybackPosition::Mark mark;
};
static_assert(std::is_trivially_copyable_v<Entry>);

}  // namespace

PlaybackPosition::PlaybackPosition(std::filesystem::path path, const Log& log)
    : path_(std::move(path)), log_(log) {
  const auto stored = StateJournal::newest(path_);
  if (stored && stored->size() == sizeof(Entry)) {
    Entry entry;
    std::memcpy(&entry, stored->data(), sizeof entry);
    if (entry.log == log_ && entry.mark.taken <= log_.records) found_ = entry.mark;
  }
  journal_ = std::make_unique<StateJournal>(path_, sizeof(Entry));
}

void PlaybackPosition::write(const Mark& mark) {
  if (!journal_ || written_ == mark) return;
  const Entry entry{log_, mark};
  journal_->write({reinterpret_cast<const char*>(&entry), sizeof entry});
  written_ = mark;
}

void PlaybackPosition::forget() {
  journal_.reset();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace coop::carmen
