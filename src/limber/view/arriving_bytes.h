// SPDX-License-Identifier: Apache-2.0
// The bytes of a stream in memory while they arrive: in order, or, where the size is known, in any order.
// Part of the player: standard library only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "limber/stream/decoder.h"

namespace limber {

class ArrivingBytes {
 public:
  // Reserves the whole, of which what has not come is zeros. False where there is no memory for it.
  // Preconditions: the size is not known yet, and prefix() <= size.
  bool set_size(std::uint64_t size);
  std::optional<std::uint64_t> size() const { return size_; }

  // Adds to the prefix. False where there is no memory. Precondition: they are within the size where that is known.
  bool append(std::span<const std::byte> more);

  // Preconditions: the size is known, and they are within it. What is there already stays.
  void supply(std::uint64_t offset, std::span<const std::byte> more);

  // All that is there, of a known size with zeros where nothing is. The next call that adds may move it.
  std::span<const std::byte> bytes() const { return {data_.get(), static_cast<std::size_t>(size_.value_or(prefix()))}; }

  // How many bytes are there from the beginning on without a gap, and in all.
  std::uint64_t prefix() const;
  std::uint64_t count() const;

  // The first bytes within `extent` that are not there, up to the next that are; begin == end where all are.
  Extent first_missing(const Extent& extent) const;
  bool has(const Extent& extent) const;

 private:
  bool reserve(std::uint64_t size);
  void note(const Extent& extent);

  struct Free {
    void operator()(std::byte* memory) const { std::free(memory); }
  };
  std::unique_ptr<std::byte[], Free> data_;
  std::size_t capacity_ = 0;
  std::optional<std::uint64_t> size_;
  std::vector<Extent> there_;  // in order, none empty, none touching the next
};

}  // namespace limber
