// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/report_page.hpp"

namespace talus {
namespace {

using testing::ElementsAre;

std::string unpacked(const std::string& text, std::size_t size) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t word = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6U | static_cast<std::uint32_t>(letters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> bits);
  }
  std::string out(size, '\0');
  uLongf length = size;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                       bytes.size()),
            Z_OK);
  EXPECT_EQ(length, size);
  return out;
}

/// As the page undoes it (web/report/src/data.js).
std::vector<double> values_of(const PackedFrames& packed, std::size_t count, std::size_t per_frame) {
  const std::string bytes = unpacked(packed.text, 2 * count);
  std::vector<std::uint16_t> codes(count);
  for (std::size_t n = 0; n < count; ++n)
    codes[n] = static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[n]) |
                                          static_cast<unsigned char>(bytes[count + n]) << 8);
  for (std::size_t n = per_frame; n < count; ++n)
    codes[n] = static_cast<std::uint16_t>(codes[n] + codes[n - per_frame]);
  std::vector<double> values;
  for (const std::uint16_t code : codes)
    values.push_back(code == packed.levels ? std::nan("")
                                           : packed.low + code * (packed.high - packed.low) / (packed.levels - 1));
  return values;
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");  // RFC 4648, section 10
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(PackFrames, GivesEachValueBackWithinHalfALevel) {
  std::vector<float> values;
  for (int n = 0; n < 300; ++n) values.push_back(static_cast<float>(std::sin(0.1 * n) * 3 - 1));
  for (const int levels : {2, 1023, 65535}) {
    const PackedFrames packed = pack_frames(values, 50, levels);
    const std::vector<double> back = values_of(packed, values.size(), 50);
    const double half = 0.5 * (packed.high - packed.low) / (levels - 1);
    for (std::size_t n = 0; n < values.size(); ++n) EXPECT_NEAR(back[n], values[n], half * 1.0001) << n;
  }
}

TEST(PackFrames, KnowsValuesThatAreNone) {
  const float none = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const PackedFrames packed = pack_frames(std::vector<float>{none, 2, 4, inf, 2, none}, 2, 65535);
  EXPECT_EQ(packed.low, 2);
  EXPECT_EQ(packed.high, 4);
  EXPECT_THAT(values_of(packed, 6, 2),
              ElementsAre(testing::NanSensitiveDoubleEq(std::nan("")), 2, 4,
                          testing::NanSensitiveDoubleEq(std::nan("")), 2, testing::NanSensitiveDoubleEq(std::nan(""))));
}

TEST(PackFrames, TakesConstantsAndNothing) {
  EXPECT_THAT(values_of(pack_frames(std::vector<float>(4, 7.5F), 2, 1023), 4, 2), ElementsAre(7.5, 7.5, 7.5, 7.5));
  EXPECT_EQ(pack_frames({}, 0, 1023).levels, 1023);
}

TEST(PackFrames, RefusesWhatItCannotPack) {
  const std::vector<float> three(3, 1.0F);
  EXPECT_THROW(pack_frames(three, 2, 1023), std::invalid_argument);
  EXPECT_THROW(pack_frames(three, 3, 1), std::invalid_argument);
  EXPECT_THROW(pack_frames(three, 3, 65536), std::invalid_argument);
}

TEST(PackNumbers, KeepsSinglePrecision) {
  const std::vector<double> values = {0, -1.5, 1e-20, 3.25e9, std::nan("")};
  const std::string bytes = unpacked(pack_numbers(values), 4 * values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k)
      word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k * values.size() + n])) << (8 * k);
    const float back = std::bit_cast<float>(word);
    EXPECT_TRUE(back == static_cast<float>(values[n]) || (std::isnan(back) && std::isnan(values[n])));
  }
}

}  // namespace
}  // namespace talus
