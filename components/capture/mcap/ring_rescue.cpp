#include "capture/mcap/ring_rescue.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "capture/mcap/ring_folder.hpp"
#include "capture/mcap/tail.hpp"

namespace coop::mcap {
namespace {

namespace fs = std::filesystem;

/// Pieces of files one behind the other.
class Joined final : public Source {
 public:
  explicit Joined(std::string name) : name_(std::move(name)) {}
  void add(const std::shared_ptr<const Source>& source, std::uint64_t begin, std::uint64_t end) {
    if (begin >= end) return;
    Piece* last = pieces_.empty() ? nullptr : &pieces_.back();
    const bool continues =
        last != nullptr && last->source == source && last->offset + (size_ - last->begin) == begin;
    if (!continues) pieces_.push_back({source, begin, size_});
    size_ += end - begin;
  }
  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read(std::uint64_t offset, std::span<std::byte> out) const override {
    if (offset > size_ || out.size() > size_ - offset) throw FileError(size_, "the ring ends here");
    auto piece = std::prev(std::ranges::upper_bound(pieces_, offset, {}, &Piece::begin));
    while (!out.empty()) {
      const auto next = std::next(piece);
      const std::uint64_t end = next == pieces_.end() ? size_ : next->begin;
      const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(end - offset, out.size()));
      piece->source->read(piece->offset + (offset - piece->begin), out.first(part));
      out = out.subspan(part);
      offset += part;
      piece = next;
    }
  }

 private:
  struct Piece {
    std::shared_ptr<const Source> source;
    std::uint64_t offset = 0;  // in it
    std::uint64_t begin = 0;   // here
  };
  std::string name_;
  std::uint64_t size_ = 0;
  std::vector<Piece> pieces_;
};

/// The whole records of a file, behind what is there; `is_first`: with its begin. What was said
/// before a segment counts for the oldest only: of the others it is in the ones before. False where
/// the file has gone meanwhile, as those of a living ring do.
bool append(Joined& all, const fs::path& path, bool with_head, bool with_messages) {
  std::shared_ptr<const Source> file;
  try {
    file = open_plain_file(path);
  } catch (const std::system_error&) {
    if (!fs::exists(path)) return false;
    throw;
  }
  try {
    const std::uint64_t begin = read_begin(file, {}).data_begin;
    if (with_head) all.add(file, 0, begin);
    RecordStream stream(file, {}, begin, file->size());
    while (const auto place = stream.next()) {
      if (place->opcode == Opcode::kDataEnd) break;
      if (with_messages || place->opcode != Opcode::kMessage) {
        all.add(file, place->offset, place->end());
      }
    }
  } catch (const FileError&) {
    // Here it was cut.
  }
  return true;
}

std::vector<fs::path> segments_of(const fs::path& folder) {
  std::vector<fs::path> segments;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_capture = entry.path().extension() == ".mcap";
    if (is_capture && entry.path().filename() != RingFolder::kBegin) {
      segments.push_back(entry.path());
    }
  }
  std::ranges::sort(segments);
  return segments;
}

/// Appended to those it has: a capture without an end goes on anywhere.
void note_in(const fs::path& capture, const Metadata& metadata) {
  ByteBuffer record;
  encode(record, metadata);
  std::ofstream(capture, std::ios::binary | std::ios::app)
      .write(reinterpret_cast<const char*>(record.data()),
             static_cast<std::streamsize>(record.size()));
}

/// NAME.mcap, or NAME-2.mcap and so on where that is taken.
fs::path unused(const fs::path& wanted) {
  fs::path path = wanted;
  for (int number = 2; fs::exists(path); ++number) {
    path.replace_filename(wanted.stem().string() + "-" + std::to_string(number) +
                          wanted.extension().string());
  }
  return path;
}

/// Of a living ring that is in a hurry, a file may go before it is read: nothing then.
std::shared_ptr<const Source> open_as_it_is(const fs::path& folder) {
  const auto tail = read_tail(folder / RingFolder::kTailOf);
  auto all = std::make_shared<Joined>(folder.string());
  append(*all, folder / RingFolder::kBegin, true, false);
  bool is_first = true;
  for (const fs::path& segment : segments_of(folder)) {
    if (!append(*all, segment, all->size() == 0, is_first)) return nullptr;
    is_first = false;
  }
  return with_tail(std::move(all), tail);
}
constexpr int kTries = 100;

bool is_own_folder(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
         status.st_uid == ::geteuid();
}

}  // namespace

std::shared_ptr<const Source> open_ring(const fs::path& folder) {
  for (int left = kTries; left > 0; --left) {
    if (!fs::exists(folder / RingFolder::kOrigin)) {
      throw std::system_error(EISDIR, std::generic_category(), folder.string());
    }
    if (auto ring = open_as_it_is(folder)) return ring;
  }
  throw std::system_error(EAGAIN, std::generic_category(), folder.string());
}

DeadRing::DeadRing(fs::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {
  std::ifstream in(folder_ / RingFolder::kOrigin);
  std::string text;
  std::getline(in, text, '\0');
  origin_ = text;
}

DeadRing::DeadRing(DeadRing&& other) noexcept
    : folder_(std::move(other.folder_)),
      origin_(std::move(other.origin_)),
      lock_(std::exchange(other.lock_, -1)) {}

DeadRing::~DeadRing() {
  if (lock_ >= 0) ::close(lock_);
}

std::vector<DeadRing> DeadRing::all_in(const fs::path& folder) {
  std::vector<DeadRing> dead;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (!path.filename().string().starts_with(RingFolder::kPrefix) || !is_own_folder(path))
      continue;
    const int lock = ::open((path / RingFolder::kOrigin).c_str(), O_RDONLY | O_CLOEXEC);
    if (lock < 0) continue;
    struct stat status {};
    // Without a name: somebody else has written it out meanwhile.
    if (::flock(lock, LOCK_EX | LOCK_NB) == 0 && ::fstat(lock, &status) == 0 &&
        status.st_nlink > 0) {
      dead.push_back(DeadRing(path, lock));
    } else {
      ::close(lock);
    }
  }
  return dead;
}

std::uint64_t DeadRing::bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& file : fs::directory_iterator(folder_)) bytes += file.file_size();
  return bytes;
}

DeadRing::Written DeadRing::write(const Metadata& about, std::uint64_t reserve) {
  Written written;
  // The captures' folder is made with the first of them; the run's is there as long as it is
  // wanted.
  if (origin_.is_absolute() && fs::exists(origin_.parent_path().parent_path())) {
    note_in(folder_ / RingFolder::kBegin, about);
    fs::create_directories(origin_.parent_path());
    auto part = origin_.parent_path() / folder_.filename();
    part += ".part";
    try {
      const auto ring = open_ring(folder_);
      if (ring->size() > 0) written.messages = recover(ring, create_file(part, reserve)).messages;
      if (written.messages > 0) {
        written.path = unused(origin_);
        fs::rename(part, written.path);
      }
    } catch (...) {
      std::error_code ignored;
      fs::remove(part, ignored);
      throw;
    }
    if (written.messages == 0) fs::remove(part);
  }
  fs::remove_all(folder_);
  return written;
}

}  // namespace coop::mcap
