#pragma once
#include <Eigen/Core>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// State to bytes and back, to the bit, on one machine: what the journal holds. A class that can be
/// stored has `template <class Archive> void persist(Archive& archive)`, which hands its members to
/// `archive(...)` in a fixed order; one function serves writing and reading.
namespace coop::simulator {

template <class T, class Archive>
concept Persistent = requires(T& value, Archive& archive) {
  value.persist(archive);
};

template <class Derived>
class ArchiveBase {
 public:
  template <class... Values>
  void operator()(Values&... values) {
    (visit(values), ...);
  }

 private:
  Derived& self() { return static_cast<Derived&>(*this); }

  template <class T>
  void visit(T& value) {
    if constexpr (Persistent<T, Derived>) {
      value.persist(self());
    } else {
      static_assert(std::is_trivially_copyable_v<T>, "give the class a persist()");
      self().raw(&value, sizeof value);
    }
  }
  template <int Rows, int Columns>
  void visit(Eigen::Matrix<double, Rows, Columns>& value) {
    static_assert(Rows != Eigen::Dynamic && Columns != Eigen::Dynamic);
    self().raw(value.data(), sizeof(double) * Rows * Columns);
  }
  void visit(std::string& value) {
    value.resize(self().size(value.size()));
    self().raw(value.data(), value.size());
  }
  template <class T>
  void visit(std::vector<T>& values) {
    values.resize(self().size(values.size()));
    for (T& value : values) visit(value);
  }
};

class ArchiveWriter : public ArchiveBase<ArchiveWriter> {
 public:
  /// Appends to `out`, which keeps its capacity between uses.
  explicit ArchiveWriter(std::string& out) : out_(out) {}
  void raw(const void* data, std::size_t bytes) {
    out_.append(static_cast<const char*>(data), bytes);
  }
  std::size_t size(std::size_t value) {
    raw(&value, sizeof value);
    return value;
  }

 private:
  std::string& out_;
};

/// Throws std::runtime_error where the bytes end too early.
class ArchiveReader : public ArchiveBase<ArchiveReader> {
 public:
  explicit ArchiveReader(std::string_view in) : in_(in) {}
  void raw(void* data, std::size_t bytes) {
    if (bytes > in_.size()) throw std::runtime_error("stored state ends too early");
    std::memcpy(data, in_.data(), bytes);
    in_.remove_prefix(bytes);
  }
  std::size_t size(std::size_t /*current*/) {
    std::size_t value = 0;
    raw(&value, sizeof value);
    if (value > in_.size()) throw std::runtime_error("stored state is damaged");
    return value;
  }
  [[nodiscard]] bool at_end() const { return in_.empty(); }

 private:
  std::string_view in_;
};

}  // namespace coop::simulator
