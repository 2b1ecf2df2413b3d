#include "capture/mcap/definitions.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace coop::mcap {
namespace {

/// Ids begin at 1: schema 0 means "none".
template <class T>
std::uint16_t id_of(std::deque<T>& known, T wanted, const char* what) {
  for (const T& one : known) {
    wanted.id = one.id;
    if (one == wanted) return one.id;
  }
  if (known.size() >= std::numeric_limits<std::uint16_t>::max()) {
    throw std::length_error(std::string("MCAP: a file holds at most 65535 ") + what);
  }
  wanted.id = static_cast<std::uint16_t>(known.size() + 1);
  known.push_back(std::move(wanted));
  return known.back().id;
}

template <class T>
std::vector<const T*> addresses_after(const std::deque<T>& known, std::size_t first) {
  std::vector<const T*> out;
  for (std::size_t i = first; i < known.size(); ++i) out.push_back(&known[i]);
  return out;
}

}  // namespace

std::uint16_t Definitions::schema(std::string_view name, std::string_view encoding,
                                  std::string_view data) {
  const std::lock_guard lock(mutex_);
  return id_of(schemas_, Schema{0, std::string(name), std::string(encoding), std::string(data)},
               "schemas");
}

std::uint16_t Definitions::channel(std::uint16_t schema_id, std::string_view topic,
                                   std::string_view message_encoding,
                                   const std::map<std::string, std::string>& metadata) {
  const std::lock_guard lock(mutex_);
  if (schema_id > schemas_.size()) {
    throw std::invalid_argument("MCAP: channel '" + std::string(topic) + "' names schema " +
                                std::to_string(schema_id) + ", which there is not");
  }
  return id_of(channels_,
               Channel{0, schema_id, std::string(topic), std::string(message_encoding), metadata},
               "channels");
}

Definitions::View Definitions::after(std::size_t schemas, std::size_t channels) const {
  const std::lock_guard lock(mutex_);
  return {addresses_after(schemas_, schemas), addresses_after(channels_, channels)};
}

}  // namespace coop::mcap
