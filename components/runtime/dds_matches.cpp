#include "runtime/dds_matches.hpp"

#include <sstream>

namespace coop::runtime {

std::string identity(const eprosima::fastrtps::rtps::GUID_t& guid) {
  std::ostringstream out;
  out << guid;
  return std::move(out).str();
}

void Matches::change(const eprosima::fastrtps::rtps::InstanceHandle_t& counterpart, int change) {
  eprosima::fastrtps::rtps::GUID_t guid;
  eprosima::fastrtps::rtps::iHandle2GUID(guid, counterpart);
  {
    const std::scoped_lock lock(mutex_);
    if (change > 0) {
      counterparts_.insert(identity(guid));
    } else {
      counterparts_.erase(identity(guid));
    }
  }
  if (const auto callback = on_match_.lock()) (*callback)();
}

void Matches::clear() {
  {
    const std::scoped_lock lock(mutex_);
    counterparts_.clear();
  }
  if (const auto callback = on_match_.lock()) (*callback)();
}

bool Matches::contains(const std::string& id) const {
  const std::scoped_lock lock(mutex_);
  return counterparts_.contains(id);
}

int Matches::count() const {
  const std::scoped_lock lock(mutex_);
  return static_cast<int>(counterparts_.size());
}

}  // namespace coop::runtime
