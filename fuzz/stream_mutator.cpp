// SPDX-License-Identifier: Apache-2.0
// Changes inside a stream that keep its skeleton: of one chunk, or of one section of a frame, which may get longer or
// shorter. Changes without regard to it, every other time, see to the skeleton itself.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "limber/stream/chunk.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace limber;

struct Place {
  std::size_t begin = 0, size = 0;
  std::vector<std::size_t> lengths;  // where the numbers lie that say how long this is
};

std::uint32_t get(const std::uint8_t* at) {
  return load_little_endian<std::uint32_t>(reinterpret_cast<const std::byte*>(at));
}

std::vector<Place> places(const std::uint8_t* data, std::size_t size) {
  std::vector<Place> found;
  for (std::size_t at = kPreambleSize; at < size && size - at > kChunkHeaderSize;) {
    const std::size_t payload = at + kChunkHeaderSize, length = get(data + at + 8);
    if (length > size - payload) break;
    found.push_back({payload, length, {at + 8}});
    const std::uint32_t kind = get(data + at);
    std::size_t section = payload + kSectionTableSize;
    for (std::size_t i = 0; (kind == kKeyChunk || kind == kStepChunk) && i < kSectionCount; ++i) {
      if (section > payload + length) break;
      const std::size_t section_length = get(data + payload + 4 * i);
      if (section_length > payload + length - section) break;
      found.push_back({section, section_length, {at + 8, payload + 4 * i}});
      section += section_length;
    }
    at = payload + length;
  }
  return found;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  const std::vector<Place> all = places(data, size);
  if (all.empty() || seed % 2 == 0) return LLVMFuzzerMutate(data, size, max_size);
  const Place& place = all[seed / 2 % all.size()];
  const std::size_t room = std::min(place.size + (max_size - size), 2 * place.size + 8);
  std::vector<std::uint8_t> part(data + place.begin, data + place.begin + place.size);
  part.resize(std::max<std::size_t>(room, 1));
  const std::size_t changed = std::min(LLVMFuzzerMutate(part.data(), place.size, part.size()), room);
  std::memmove(data + place.begin + changed, data + place.begin + place.size, size - place.begin - place.size);
  std::copy_n(part.data(), changed, data + place.begin);
  for (const std::size_t length : place.lengths) {
    const auto now = static_cast<std::uint32_t>(get(data + length) + changed - place.size);
    for (std::size_t i = 0; i < 4; ++i) data[length + i] = static_cast<std::uint8_t>(now >> (8 * i));
  }
  return size + changed - place.size;
}
