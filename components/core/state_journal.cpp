#include "core/state_journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/hash.hpp"

namespace coop {
namespace {

constexpr std::uint64_t kMagic = 0x31304E524A4D4953ULL;  // "SIMJRN01"

struct BlockHeader {
  std::uint64_t magic = kMagic;
  std::uint64_t number = 0;    ///< of the record, from 1
  std::uint64_t length = 0;    ///< of the record
  std::uint64_t checksum = 0;  ///< over number and record
};

std::uint64_t checksum(std::uint64_t number, std::string_view record) {
  Fnv1a hash;
  hash.add_word(number);
  hash.add(record);
  return hash.value();
}

struct Record {
  std::uint64_t number;
  std::string_view content;
};

std::optional<Record> parse(std::string_view file, std::size_t offset) {
  BlockHeader header;
  if (file.size() < offset + sizeof header) return std::nullopt;
  std::memcpy(&header, file.data() + offset, sizeof header);
  const std::string_view rest = file.substr(offset + sizeof header);
  if (header.magic != kMagic || header.length > rest.size()) return std::nullopt;
  const std::string_view content = rest.substr(0, header.length);
  if (checksum(header.number, content) != header.checksum) return std::nullopt;
  return Record{header.number, content};
}

/// The newest whole record of a file's content.
std::optional<Record> find_newest(std::string_view file) {
  std::optional<Record> best = parse(file, 0);
  const std::size_t half = file.size() / 2;
  if (const auto other = parse(file, half); other && (!best || other->number > best->number)) {
    best = other;
  }
  return best;
}

[[noreturn]] void throw_errno(const char* what, const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), what + (" " + path.string()));
}

}  // namespace

StateJournal::StateJournal(const std::filesystem::path& path, std::size_t capacity)
    : path_(path), slot_size_(sizeof(BlockHeader) + capacity) {
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path());
  std::string old;
  if (std::filesystem::exists(path_)) old = read_file(path_);
  const bool fits = old.size() == 2 * slot_size_;
  const std::optional<Record> newest = fits ? find_newest(old) : std::nullopt;
  if (newest) number_ = newest->number;

  fd_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | (fits ? 0 : O_TRUNC), 0644);
  if (fd_ < 0) throw_errno("cannot open", path_);
  if (::ftruncate(fd_, static_cast<off_t>(2 * slot_size_)) != 0) throw_errno("cannot size", path_);
}

StateJournal::~StateJournal() {
  if (fd_ >= 0) ::close(fd_);
}

void StateJournal::write(std::string_view record) {
  if (sizeof(BlockHeader) + record.size() > slot_size_) {
    throw std::length_error("journal record too long");
  }
  ++number_;
  const BlockHeader header{kMagic, number_, record.size(), checksum(number_, record)};
  block_.assign(reinterpret_cast<const char*>(&header), sizeof header);
  block_.append(record);
  const auto offset = static_cast<off_t>((number_ % 2) * slot_size_);
  if (::pwrite(fd_, block_.data(), block_.size(), offset) != static_cast<ssize_t>(block_.size())) {
    throw_errno("cannot write", path_);
  }
}

std::optional<std::string> StateJournal::newest(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  const std::string file = read_file(path);
  const auto record = find_newest(file);
  if (!record) return std::nullopt;
  return std::string(record->content);
}

}  // namespace coop
