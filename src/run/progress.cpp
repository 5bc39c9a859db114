// SPDX-License-Identifier: Apache-2.0
#include "run/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace talus::run {

namespace {

using namespace std::chrono_literals;

constexpr auto between_live_lines = 200ms;
constexpr auto between_lines = 1s;  // a run of a second needs no ten lines
constexpr auto first_line = 5s;     // of a phase whose first tenth takes long
constexpr int samples_of_a_phase = 200;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

std::size_t width_of(std::FILE* stream) {
  winsize size{};
  const bool known = ::ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col : 80;
}

}  // namespace

std::string format_seconds(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds > 3.15e10) return "more than a thousand years";
  const auto s = static_cast<std::int64_t>(std::llround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  constexpr std::int64_t day = 86400;
  if (s < 2 * day) return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
  if (s < 60 * day) return fmt::format("{} days", std::llround(seconds / day));
  if (s < 730 * day) return fmt::format("{} months", std::llround(seconds / (30.44 * day)));
  return fmt::format("{} years", std::llround(seconds / (365.25 * day)));
}

std::string cut(std::string_view text, std::size_t width) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
    if (begins && ++characters > width) return std::string(text.substr(0, i));
  }
  return std::string(text);
}

Progress::Progress(std::FILE* stream, Log log)
    : stream_(stream), log_(std::move(log)), terminal_(isatty(fileno(stream)) != 0) {
  begin({});
}

Progress::~Progress() {
  finish();
}

void Progress::begin(const Phase& phase) {
  phase_ = phase;
  began_ = Clock::now();
  next_live_ = began_ + between_live_lines;
  samples_.assign(1, {began_, phase.start});
  tenths_ = 0;
  told_ = false;
}

void Progress::take_sample(Clock::time_point clock, double now) {
  const auto gap = std::max<Clock::duration>(100ms, (clock - began_) / samples_of_a_phase);
  if (clock - samples_.back().clock < gap) return;
  samples_.push_back({clock, now});
  const double recent = std::max(phase_.recent * seconds(clock - began_), 10.0);
  while (samples_.size() > 2 && phase_.recent < 1 && seconds(clock - samples_[1].clock) >= recent) samples_.pop_front();
}

double Progress::share_done(double now) const {
  return phase_.end > phase_.start ? std::clamp((now - phase_.start) / (phase_.end - phase_.start), 0.0, 1.0) : 1;
}

bool Progress::is_line_due(Clock::time_point clock, double now) const {
  if (clock - last_line_ < between_lines) return false;
  return std::floor(10 * share_done(now)) > tenths_ || (!told_ && clock - began_ >= first_line);
}

bool Progress::is_due(Clock::time_point clock, double now) const {
  return (terminal_ && clock >= next_live_) || is_line_due(clock, now);
}

std::string Progress::time_left(Clock::time_point clock, double now) const {
  const double speed = (now - samples_.front().now) / seconds(clock - samples_.front().clock);
  const auto lasts = [&](double length) { return format_seconds(std::max(0.0, length) / speed); };
  if (!phase_.name.empty())
    return fmt::format("{}, at most {}{}", phase_.name, speed > 0 ? lasts(phase_.end - now) : "until its limit",
                       speed > 0 && phase_.after > 0 ? ", then about " + lasts(phase_.after) : "");
  return fmt::format("{:3.0f} %{}", 100 * share_done(now), speed > 0 ? "  ETA " + lasts(phase_.end - now) : "");
}

void Progress::show(Clock::time_point clock, double now, const std::string& text) {
  const std::string line = text + "  " + time_left(clock, now);
  if (is_line_due(clock, now)) {
    if (log_) log_(line);
    if (!terminal_) std::fprintf(stream_, "%s\n", line.c_str());
    tenths_ = static_cast<int>(std::floor(10 * share_done(now)));
    told_ = true;
    last_line_ = clock;
  }
  if (terminal_) std::fprintf(stream_, "\r\033[K%s", cut(line, width_of(stream_) - 1).c_str());
  next_live_ = clock + between_live_lines;
  std::fflush(stream_);
  shown_ = true;
}

void Progress::finish() {
  if (shown_ && terminal_) std::fprintf(stream_, "\r\033[K");
  std::fflush(stream_);
  shown_ = false;
}

Waiting::Waiting(std::string phase, std::FILE* stream, double first)
    : phase_(std::move(phase)), stream_(stream), thread_([this, first] { watch(first); }) {}

Waiting::~Waiting() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_all();
  thread_.join();
}

void Waiting::watch(double first) {
  using Seconds = std::chrono::duration<double>;
  constexpr Seconds per_live_line{1}, per_line{60};
  const bool terminal = isatty(fileno(stream_)) != 0;
  const auto began = std::chrono::steady_clock::now();
  bool shown = false;
  Seconds next{first};
  std::unique_lock lock(mutex_);
  while (!over_.wait_until(lock, began + std::chrono::duration_cast<std::chrono::nanoseconds>(next),
                           [this] { return is_over_; })) {
    const std::string line = fmt::format("{} ... {}", phase_, format_seconds(next.count()));
    std::fprintf(stream_, terminal ? "\r\033[K%s" : "%s\n", line.c_str());
    std::fflush(stream_);
    shown = true;
    next += terminal ? per_live_line : std::min(next, per_line);
  }
  if (shown && terminal) {
    std::fprintf(stream_, "\r\033[K");
    std::fflush(stream_);
  }
}

}  // namespace talus::run
