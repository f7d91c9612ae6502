// SPDX-License-Identifier: MIT
#include "risorius/io/detail/inflate.h"

#include <array>
#include <cstdint>

namespace risorius::io::detail {

namespace {

constexpr int kLongestCode = 15;
constexpr int kEndOfBlock = 256, kLengthCodes = 29, kDistanceCodes = 30;

/// A canonical Huffman code: symbols in the order of their codes, and how many there are of each length.
class HuffmanCode {
  public:
    /// Returns false for lengths that no code has: more codes of a length than bits allow.
    bool build(const std::uint8_t* lengths, int count) {
        count_.fill(0);
        for (int s = 0; s < count; ++s) ++count_[lengths[s]];
        count_[0] = 0;
        long left = 1;
        for (int bits = 1; bits <= kLongestCode; ++bits) {
            left = 2 * left - count_[static_cast<std::size_t>(bits)];
            if (left < 0) return false;
        }
        std::array<int, kLongestCode + 2> first{};
        for (std::size_t bits = 1; bits <= kLongestCode; ++bits)
            first[bits + 1] = first[bits] + count_[bits];
        for (int s = 0; s < count; ++s)
            if (lengths[s] > 0)
                symbol_[static_cast<std::size_t>(first[lengths[s]]++)] =
                    static_cast<std::uint16_t>(s);
        return true;
    }
    /// `next_bit` returns -1 at the end of the data; so does this, and for bits that are no code.
    template <class NextBit>
    int decode(const NextBit& next_bit) const {
        int code = 0, first = 0, index = 0;
        for (std::size_t bits = 1; bits <= kLongestCode; ++bits) {
            const int bit = next_bit();
            if (bit < 0) return -1;
            code |= bit;
            if (code - first < count_[bits])
                return symbol_[static_cast<std::size_t>(index + code - first)];
            index += count_[bits];
            first = (first + count_[bits]) << 1;
            code <<= 1;
        }
        return -1;
    }

  private:
    std::array<int, kLongestCode + 1> count_{};
    std::array<std::uint16_t, 288> symbol_{};
};

class Inflater {
  public:
    Inflater(std::string_view packed, std::size_t most_bytes, std::string& out)
        : in_(packed), most_(most_bytes), begin_(out.size()), out_(out) {}

    std::string run() {
        if (in_.size() < 6) return "fewer bytes than a header";
        const unsigned method = byte(0), flags = byte(1);
        if ((method & 15) != 8 || (256 * method + flags) % 31 != 0 || (flags & 32) != 0)
            return "another header than that of zlib";
        at_ = 2;
        for (bool last = false; !last;) {
            last = bits(1) == 1;
            const long kind = bits(2);
            const std::string wrong = kind == 0   ? stored()
                                      : kind == 1 ? packed_block(false)
                                      : kind == 2 ? packed_block(true)
                                                  : "no kind of block";
            if (!wrong.empty()) return wrong;
        }
        if (in_.size() - at_ < 4) return "no checksum";
        std::uint32_t expected = 0;
        for (int k = 0; k < 4; ++k) expected = expected << 8 | byte(at_++);
        return expected == checksum() ? "" : "another checksum";
    }

  private:
    unsigned byte(std::size_t at) const { return static_cast<unsigned char>(in_[at]); }
    /// The next bits, the lowest first; -1 at the end.
    long bits(int count) {
        long value = 0;
        for (int k = 0; k < count; ++k) {
            if (have_ == 0) {
                if (at_ >= in_.size()) return -1;
                held_ = byte(at_++);
                have_ = 8;
            }
            value |= static_cast<long>(held_ & 1) << k;
            held_ >>= 1;
            --have_;
        }
        return value;
    }
    std::string stored() {
        have_ = 0;
        if (in_.size() - at_ < 4) return "an end within a block";
        const std::size_t length = byte(at_) | byte(at_ + 1) << 8;
        if (length != (~(byte(at_ + 2) | byte(at_ + 3) << 8) & 0xffff)) return "another length";
        at_ += 4;
        if (in_.size() - at_ < length) return "an end within a block";
        if (length > most_ - (out_.size() - begin_)) return "more bytes than it should hold";
        out_.append(in_.substr(at_, length));
        at_ += length;
        return "";
    }
    /// The lengths of the codes of a block, themselves coded.
    std::string read_codes() {
        static constexpr std::uint8_t kOrder[19] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                    11, 4,  12, 3, 13, 2, 14, 1, 15};
        const long literals = bits(5) + 257, distances = bits(5) + 1, codes = bits(4) + 4;
        std::array<std::uint8_t, 320> lengths{};
        for (long k = 0; k < codes; ++k) {
            const long length = bits(3);
            if (length < 0) return "an end within a block";
            lengths[kOrder[k]] = static_cast<std::uint8_t>(length);
        }
        HuffmanCode code;
        if (literals > 286 || distances > kDistanceCodes || !code.build(lengths.data(), 19))
            return "no code";
        lengths.fill(0);
        for (long k = 0; k < literals + distances;) {
            const int symbol = code.decode([&] { return static_cast<int>(bits(1)); });
            if (symbol < 0) return "no code";
            if (symbol < 16) {
                lengths[static_cast<std::size_t>(k++)] = static_cast<std::uint8_t>(symbol);
                continue;
            }
            const long more = symbol == 16 ? bits(2) : symbol == 17 ? bits(3) : bits(7);
            long times = more + (symbol == 18 ? 11 : 3);
            if (more < 0 || k + times > literals + distances || (symbol == 16 && k == 0))
                return "no code";
            const std::uint8_t length =
                symbol == 16 ? lengths[static_cast<std::size_t>(k - 1)] : std::uint8_t{0};
            for (; times > 0; --times) lengths[static_cast<std::size_t>(k++)] = length;
        }
        if (!literal_.build(lengths.data(), static_cast<int>(literals)) ||
            !distance_.build(lengths.data() + literals, static_cast<int>(distances)))
            return "no code";
        return "";
    }
    void fixed_codes() {
        std::array<std::uint8_t, 288> lengths{};
        for (std::size_t s = 0; s < lengths.size(); ++s)
            lengths[s] = s < 144 ? 8 : s < 256 ? 9 : s < 280 ? 7 : 8;
        literal_.build(lengths.data(), 288);
        lengths.fill(5);
        distance_.build(lengths.data(), kDistanceCodes);
    }
    std::string packed_block(bool own_codes) {
        if (own_codes) {
            const std::string wrong = read_codes();
            if (!wrong.empty()) return wrong;
        } else {
            fixed_codes();
        }
        const auto next_bit = [&] { return static_cast<int>(bits(1)); };
        while (true) {
            const int symbol = literal_.decode(next_bit);
            if (symbol < 0) return "no code";
            if (symbol == kEndOfBlock) return "";
            if (symbol < kEndOfBlock) {
                if (out_.size() - begin_ >= most_) return "more bytes than it should hold";
                out_ += static_cast<char>(symbol);
                continue;
            }
            const std::string wrong = copy(symbol - kEndOfBlock - 1);
            if (!wrong.empty()) return wrong;
        }
    }
    /// Repeats earlier bytes. Lengths and distances grow in groups of four and of two codes with the same number of extra bits.
    std::string copy(int length_code) {
        if (length_code >= kLengthCodes) return "no code";
        long length = 258;
        if (length_code < 8) {
            length = 3 + length_code;
        } else if (length_code < kLengthCodes - 1) {
            const int extra = length_code / 4 - 1;
            const long more = bits(extra);
            if (more < 0) return "an end within a block";
            length = 3 + ((4L + length_code % 4) << extra) + more;
        }
        const int distance_code = distance_.decode(
            [&] { return static_cast<int>(bits(1)); });  // behind the length's bits
        if (distance_code < 0 || distance_code >= kDistanceCodes) return "no code";
        long distance = 1 + distance_code;
        if (distance_code >= 4) {
            const int extra = distance_code / 2 - 1;
            const long more = bits(extra);
            if (more < 0) return "an end within a block";
            distance = 1 + ((2L + distance_code % 2) << extra) + more;
        }
        const std::size_t written = out_.size() - begin_;
        if (static_cast<std::size_t>(distance) > written) return "bytes from before its begin";
        if (static_cast<std::size_t>(length) > most_ - written)
            return "more bytes than it should hold";
        for (long k = 0; k < length; ++k)
            out_ += out_[out_.size() - static_cast<std::size_t>(distance)];
        return "";
    }
    std::uint32_t checksum() const {
        std::uint32_t a = 1, b = 0;
        for (std::size_t at = begin_; at < out_.size(); ++at) {
            a = (a + static_cast<unsigned char>(out_[at])) % 65521;
            b = (b + a) % 65521;
        }
        return b << 16 | a;
    }

    std::string_view in_;
    std::size_t most_, begin_, at_ = 0;
    std::string& out_;
    unsigned held_ = 0;
    int have_ = 0;
    HuffmanCode literal_, distance_;
};

}  // namespace

std::string inflate(std::string_view packed, std::size_t most_bytes, std::string& out) {
    return Inflater(packed, most_bytes, out).run();
}

}  // namespace risorius::io::detail
