#include "capture/mcap/tail.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>

namespace coop::mcap {
namespace {

std::size_t in_pages(std::size_t size) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return (size + page - 1) / page * page;
}

}  // namespace

std::size_t Tail::slot_size(std::size_t capacity) {
  return in_pages(kHead + capacity);
}

std::filesystem::path Tail::path_of(const std::filesystem::path& capture) {
  return capture.string() + ".tail";
}

Tail::Tail(std::filesystem::path path)
    : path_(std::move(path)),
      fd_(::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), path_.string());
}

Tail::~Tail() {
  ::close(fd_);
}

void Tail::rename(std::filesystem::path path) {
  std::error_code ignored;
  std::filesystem::rename(path_, path, ignored);
  path_ = std::move(path);
}

void Tail::remove() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

std::unique_ptr<Tail::Slot> Tail::add_slot(std::size_t capacity) {
  const std::size_t length = slot_size(capacity);
  const auto offset = static_cast<off_t>(size_);
  // With its blocks: a full disk must show here and not when the memory is touched.
  if (::posix_fallocate(fd_, offset, static_cast<off_t>(length)) != 0) return nullptr;
  void* memory = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, offset);
  if (memory == MAP_FAILED) return nullptr;
  const std::uint64_t begin = size_;
  size_ += length;
  return std::unique_ptr<Slot>(new Slot(*this, begin, memory, capacity));
}

Tail::Slot::Slot(Tail& tail, std::uint64_t offset, void* memory, std::size_t capacity)
    : tail_(tail), offset_(offset), head_(new (memory) Head), capacity_(capacity) {
  head_->capacity = capacity;
  head_->magic = kSlotMagic;
}

Tail::Slot::~Slot() {
  clear();
  const std::size_t length = slot_size(capacity_);
  ::munmap(head_, length);
  // Where the file system has no holes, the blocks stay until the tail is removed.
  static_cast<void>(::fallocate(tail_.fd_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
                                static_cast<off_t>(offset_ + kHead),
                                static_cast<off_t>(length - kHead)));
}

std::byte* Tail::Slot::records() const {
  return reinterpret_cast<std::byte*>(head_) + kHead;
}

void Tail::Slot::publish(Bytes bytes) {
  if (bytes.data() != records()) return;
  if (head_->size.load(std::memory_order_relaxed) == 0) {
    head_->ordinal.store(++tail_.ordinal_, std::memory_order_relaxed);
  }
  head_->size.store(bytes.size(), std::memory_order_release);
}

void Tail::Slot::clear() {
  head_->size.store(0, std::memory_order_release);
}

void* Tail::Slot::do_allocate(std::size_t bytes, std::size_t alignment) {
  if (is_taken_ || bytes > capacity_) {
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  is_taken_ = true;
  return records();
}

void Tail::Slot::do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) {
  if (memory != records()) {
    return std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
  }
  clear();
  is_taken_ = false;
}

}  // namespace coop::mcap
