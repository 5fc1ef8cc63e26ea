// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/content_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include "toile/core/assert.h"

namespace toile {

struct ContentHasher::State {
  XXH3_state_t* xxh = XXH3_createState();
};

ContentHasher::ContentHasher() : state_(std::make_unique<State>()) {
  TOILE_ASSERT(state_->xxh != nullptr);
  XXH3_128bits_reset(state_->xxh);
}

ContentHasher::~ContentHasher() {
  XXH3_freeState(state_->xxh);
}

ContentHasher& ContentHasher::bytes(const void* data, std::size_t size) {
  XXH3_128bits_update(state_->xxh, data, size);
  return *this;
}

ContentHasher& ContentHasher::add(std::string_view text) {
  add(std::uint64_t{text.size()});
  return bytes(text.data(), text.size());
}

ContentHash ContentHasher::finish() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
  return {{hash.high64, hash.low64}};
}

std::string ContentHash::hex() const {
  return fmt::format("{:016x}{:016x}", words[0], words[1]);
}

}  // namespace toile
