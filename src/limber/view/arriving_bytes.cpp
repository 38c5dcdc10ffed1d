// SPDX-License-Identifier: Apache-2.0
#include "limber/view/arriving_bytes.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

namespace limber {

bool ArrivingBytes::reserve(std::uint64_t size) {
  if (size <= capacity_) return true;
  if (size > std::numeric_limits<std::size_t>::max() / 2) return false;
  const auto wanted = static_cast<std::size_t>(size);
  // Zeroed memory of the system is not touched until it is used.
  std::unique_ptr<std::byte[], Free> larger(static_cast<std::byte*>(std::calloc(wanted, 1)));
  if (!larger) return false;
  if (capacity_ > 0) std::memcpy(larger.get(), data_.get(), capacity_);
  data_ = std::move(larger);
  capacity_ = wanted;
  return true;
}

bool ArrivingBytes::set_size(std::uint64_t size) {
  assert(!size_ && prefix() <= size);
  if (capacity_ > size) capacity_ = static_cast<std::size_t>(prefix());
  if (!reserve(size)) return false;
  size_ = size;
  return true;
}

bool ArrivingBytes::append(std::span<const std::byte> more) {
  const std::uint64_t offset = prefix();
  assert(!size_ || offset + more.size() <= *size_);
  if (!size_ && offset + more.size() > capacity_) {
    constexpr std::uint64_t kLeast = 1 << 16;
    const std::uint64_t wanted = std::max({kLeast, 2 * std::uint64_t{capacity_}, offset + more.size()});
    if (!reserve(wanted) && !reserve(offset + more.size())) return false;
  }
  if (more.empty()) return true;
  std::memcpy(data_.get() + offset, more.data(), more.size());
  note({offset, offset + more.size()});
  return true;
}

void ArrivingBytes::supply(std::uint64_t offset, std::span<const std::byte> more) {
  assert(size_ && offset <= *size_ && more.size() <= *size_ - offset);
  const Extent extent{offset, offset + more.size()};
  for (Extent gap = first_missing(extent); gap.begin < gap.end; gap = first_missing(extent)) {
    std::memcpy(data_.get() + gap.begin, more.data() + (gap.begin - offset),
                static_cast<std::size_t>(gap.end - gap.begin));
    note(gap);
  }
}

std::uint64_t ArrivingBytes::prefix() const { return there_.empty() || there_[0].begin > 0 ? 0 : there_[0].end; }

std::uint64_t ArrivingBytes::count() const {
  std::uint64_t count = 0;
  for (const Extent& part : there_) count += part.end - part.begin;
  return count;
}

Extent ArrivingBytes::first_missing(const Extent& extent) const {
  Extent gap = extent;
  for (const Extent& part : there_) {
    if (part.end <= gap.begin) continue;
    if (part.begin > gap.begin) {
      gap.end = std::min(gap.end, part.begin);
      break;
    }
    gap.begin = std::min(part.end, extent.end);
  }
  return gap;
}

bool ArrivingBytes::has(const Extent& extent) const {
  const Extent gap = first_missing(extent);
  return gap.begin == gap.end;
}

void ArrivingBytes::note(const Extent& extent) {
  const auto touches_or_after = [&](const Extent& part) { return part.end >= extent.begin; };
  const auto first = std::find_if(there_.begin(), there_.end(), touches_or_after);
  auto last = first;
  Extent merged = extent;
  for (; last != there_.end() && last->begin <= extent.end; ++last) {
    merged = {std::min(merged.begin, last->begin), std::max(merged.end, last->end)};
  }
  const auto at = there_.erase(first, last);
  there_.insert(at, merged);
}

}  // namespace limber
