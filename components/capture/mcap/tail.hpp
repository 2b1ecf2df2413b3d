#pragma once
#include <atomic>
#include <filesystem>
#include <memory>
#include <memory_resource>
#include <vector>

#include "capture/mcap/source.hpp"

namespace coop::mcap {

/// Memory for chunks that are being filled or wait for the disk, mapped from a file beside the
/// capture, `CAPTURE.tail`: what lies in it survives the death of the process as the system's page
/// cache does, without a system call a message. The file goes when the capture is closed; where it
/// is still there, open_file() reads the capture as if its chunks had been written.
///
/// The file is slots one behind the other, each a page that tells of the records behind it.
class Tail {
 public:
  class Slot;

  /// Throws std::system_error where the file cannot be created.
  explicit Tail(std::filesystem::path path);
  ~Tail();
  Tail(const Tail&) = delete;
  Tail& operator=(const Tail&) = delete;

  /// Memory for the records of one chunk at a time; nothing where the disk has no room for it.
  [[nodiscard]] std::unique_ptr<Slot> add_slot(std::size_t capacity);
  /// It belongs to a capture of another name from now on.
  void rename(std::filesystem::path path);
  /// The capture is whole without it.
  void remove();

  [[nodiscard]] static std::filesystem::path path_of(const std::filesystem::path& capture);

  /// A slot in the file: its head, then `capacity` bytes, up to a whole page.
  static constexpr std::size_t kHead = 4096;
  static constexpr std::uint64_t kSlotMagic = 0x6c696154706f6f43;  // "CoopTail"
  [[nodiscard]] static std::size_t slot_size(std::size_t capacity);

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t ordinal_ = 0;  ///< of the chunk begun last
};

/// Gives its memory to the first that asks for no more than there is; everybody else gets memory of
/// the heap, which is lost with the process.
class Tail::Slot final : public std::pmr::memory_resource {
 public:
  /// Gives its blocks on the disk back; an empty slot stays in the file.
  ~Slot() override;
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;

  /// These are the records so far, whole ones.
  void publish(Bytes records);
  /// They are in the capture.
  void clear();

 private:
  friend class Tail;
  struct Head {
    std::uint64_t magic = 0;
    std::uint64_t capacity = 0;
    std::atomic<std::uint64_t> ordinal{0};  ///< chunks in the order in which they were begun
    std::atomic<std::uint64_t> size{0};     ///< bytes of whole records
  };
  Slot(Tail& tail, std::uint64_t offset, void* memory, std::size_t capacity);
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override;
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override {
    return this == &other;
  }
  [[nodiscard]] std::byte* records() const;

  Tail& tail_;
  std::uint64_t offset_;
  Head* head_;
  std::size_t capacity_;
  bool is_taken_ = false;
};

/// A chunk as the tail has it: whole records, should nobody have damaged them.
struct TailChunk {
  std::uint64_t ordinal = 0;  ///< in the order in which they were begun
  std::vector<std::byte> records;
};
/// Of a file, up to where it is none; slots that are larger than what is left of `max_bytes` are
/// passed over.
[[nodiscard]] std::vector<TailChunk> chunks_of_tail(const Source& tail,
                                                    std::uint64_t max_bytes = std::uint64_t{2}
                                                                              << 30U);
/// Empty where there is no tail. Of a capture that is being written the tail is to be read before
/// the capture is opened: a chunk is in one of them.
[[nodiscard]] std::vector<TailChunk> read_tail(const std::filesystem::path& capture);

/// The capture with those chunks of its tail that it lacks, as if they had been written,
/// uncompressed, behind its last whole record; the capture itself where it is complete, or none.
[[nodiscard]] std::shared_ptr<const Source> with_tail(std::shared_ptr<const Source> capture,
                                                      const std::vector<TailChunk>& tail);

}  // namespace coop::mcap
