// SPDX-License-Identifier: MIT
#include "harness/files/gunzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>
#include <string>
#include <utility>

namespace octocell {

struct Gunzip::State {
  ByteSource packed;
  z_stream stream = {};
  std::array<std::byte, std::size_t{1} << 16> input = {};
  bool between_members = true;

  /// Returns false at the end of the packed bytes.
  bool has_input() {
    if (stream.avail_in > 0) return true;
    stream.next_in = reinterpret_cast<Bytef*>(input.data());
    stream.avail_in = static_cast<uInt>(packed(input));
    return stream.avail_in > 0;
  }

  void unpack() {
    const int result = inflate(&stream, Z_NO_FLUSH);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result == Z_STREAM_END) {
      between_members = true;
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      throw GunzipError(std::string("its gzip data are damaged: ") +
                        (stream.msg != nullptr ? stream.msg : "no such data"));
    }
  }

  /// Goes on to the next member. Returns false if there is none.
  bool begin_member() {
    while (has_input() && *stream.next_in == 0 && stream.total_in > 0) {
      ++stream.next_in;
      --stream.avail_in;
    }
    if (stream.avail_in == 0) return false;
    if (*stream.next_in != 0x1f) throw GunzipError("other bytes follow its gzip data");
    inflateReset(&stream);
    between_members = false;
    return true;
  }

  std::size_t fill(std::span<std::byte> bytes) {
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_out = static_cast<uInt>(bytes.size());
    while (stream.avail_out > 0) {
      if (between_members && !begin_member()) break;
      if (!has_input()) throw GunzipError("ends in the middle of its gzip data");
      unpack();
    }
    return bytes.size() - stream.avail_out;
  }
};

Gunzip::Gunzip(ByteSource packed) : state_(std::make_unique<State>()) {
  constexpr int kGzipOnly = 16 + MAX_WBITS;
  state_->packed = std::move(packed);
  if (inflateInit2(&state_->stream, kGzipOnly) != Z_OK) throw std::bad_alloc();
}

Gunzip::~Gunzip() { inflateEnd(&state_->stream); }

std::size_t Gunzip::read(std::span<std::byte> bytes) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // zlib counts in 32 bits
  std::size_t count = 0;
  while (count < bytes.size()) {
    const std::size_t got =
        state_->fill(bytes.subspan(count, std::min(kAtOnce, bytes.size() - count)));
    if (got == 0) break;
    count += got;
  }
  return count;
}

}  // namespace octocell
