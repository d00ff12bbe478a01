#include "sketch/svg/path_data.h"

#include <array>
#include <utility>

namespace lascaux::svg {
namespace {

using Eigen::Vector2d;

/// Numbers that one repetition of a command takes; -1 for what is no command.
int ArgumentCount(char command) {
  switch (command) {
    case 'z':
      return 0;
    case 'h':
    case 'v':
      return 1;
    case 'm':
    case 'l':
    case 't':
      return 2;
    case 's':
    case 'q':
      return 4;
    case 'c':
      return 6;
    case 'a':
      return 7;
    default:
      return -1;
  }
}

class PathParser {
 public:
  PathParser(std::string_view text, int max_pieces) : cursor_(text), builder_(max_pieces) {}

  PathData Run() && {
    cursor_.SkipSpace();
    while (!cursor_.AtEnd() && fault_ == Fault::kNone) Command();
    PathData result;
    result.fault = fault_;
    result.offset = cursor_.position();
    result.subpaths = std::move(builder_).Take();
    return result;
  }

 private:
  void Command() {
    char letter = cursor_.Peek();
    const char kind = ToLower(letter);
    const int count = ArgumentCount(kind);
    if (count < 0 || (last_ == '\0' && kind != 'm')) {
      Cursor ahead = cursor_;
      ahead.Number();  // tells "NaN" from any other stray word
      fault_ = ahead.fault() == Fault::kNotFinite ? Fault::kNotFinite : Fault::kSyntax;
      return;
    }
    cursor_.Take(letter);
    cursor_.SkipSpace();
    if (count == 0) return Apply(letter);
    do {
      if (!ReadArguments(kind, count)) return;
      Apply(letter);
      if (fault_ != Fault::kNone) return;
      if (letter == 'M') letter = 'L';
      if (letter == 'm') letter = 'l';
      cursor_.SkipSeparator();
    } while (cursor_.AtNumber());
  }

  bool ReadArguments(char kind, int count) {
    for (int i = 0; i < count; ++i) {
      if (i > 0) cursor_.SkipSeparator();
      if (kind == 'a' && (i == 3 || i == 4)) {
        const std::optional<bool> flag = cursor_.Flag();
        arguments_[static_cast<std::size_t>(i)] = flag.value_or(false) ? 1 : 0;
        if (!flag) return Fail();
      } else {
        const std::optional<double> number = cursor_.Number();
        arguments_[static_cast<std::size_t>(i)] = number.value_or(0);
        if (!number) return Fail();
      }
    }
    return true;
  }

  bool Fail() {
    fault_ = cursor_.fault();
    return false;
  }

  void Apply(char letter) {
    const char kind = ToLower(letter);
    const Vector2d base = letter == kind ? builder_.position() : Vector2d::Zero();
    Vector2d control = builder_.position();
    switch (kind) {
      case 'z':
        builder_.Close();
        cursor_.SkipSpace();
        control = builder_.position();
        break;
      case 'm':
        builder_.MoveTo(base + Point(0));
        control = builder_.position();
        break;
      case 'l':
        builder_.LineTo(base + Point(0));
        break;
      case 'h':
        builder_.LineTo({base.x() + arguments_[0], builder_.position().y()});
        break;
      case 'v':
        builder_.LineTo({builder_.position().x(), base.y() + arguments_[0]});
        break;
      case 'a':
        builder_.ArcTo({Point(0).cwiseAbs(), arguments_[2], arguments_[3] != 0, arguments_[4] != 0,
                        base + Point(5)});
        break;
      case 'c':
        control = Cubic(base + Point(0), base + Point(2), base + Point(4));
        break;
      case 's':
        control = Cubic(Mirrored('c', 's'), base + Point(0), base + Point(2));
        break;
      case 'q':
        control = Quadratic(base + Point(0), base + Point(2));
        break;
      default:
        control = Quadratic(Mirrored('q', 't'), base + Point(0));
    }
    control_ = control;
    last_ = kind;
    if (builder_.overflowed()) fault_ = Fault::kTooLarge;
  }

  /// The last control point seen from the other side of the pen, if the last command was one of
  /// two.
  Vector2d Mirrored(char one, char other) const {
    const Vector2d& from = builder_.position();
    return last_ == one || last_ == other ? Vector2d(2 * from - control_) : from;
  }

  /// Both draw and return the control point that a smooth successor mirrors.
  Vector2d Cubic(const Vector2d& first, const Vector2d& second, const Vector2d& end) {
    builder_.CubicTo(first, second, end);
    return second;
  }
  Vector2d Quadratic(const Vector2d& middle, const Vector2d& end) {
    const Vector2d from = builder_.position();
    builder_.CubicTo(from + 2.0 / 3 * (middle - from), end + 2.0 / 3 * (middle - end), end);
    return middle;
  }

  Vector2d Point(std::size_t i) const { return {arguments_[i], arguments_[i + 1]}; }

  Cursor cursor_;
  PathBuilder builder_;
  std::array<double, 7> arguments_{};
  Vector2d control_ = Vector2d::Zero();
  char last_ = '\0';
  Fault fault_ = Fault::kNone;
};

}  // namespace

PathData ParsePathData(std::string_view text, int max_pieces) {
  return PathParser(text, max_pieces).Run();
}

PathData ParsePoints(std::string_view text, Ends ends, int max_pieces) {
  Cursor cursor(text);
  PathBuilder builder(max_pieces);
  PathData result;
  cursor.SkipSpace();
  for (bool first = true; !cursor.AtEnd(); first = false) {
    const std::optional<double> x = cursor.Number();
    if (x) cursor.SkipSeparator();
    const std::optional<double> y = x ? cursor.Number() : std::nullopt;
    if (!y) {
      result.fault = cursor.fault();
      break;
    }
    if (first) {
      builder.MoveTo({*x, *y});
    } else {
      builder.LineTo({*x, *y});
    }
    if (builder.overflowed()) {
      result.fault = Fault::kTooLarge;
      break;
    }
    cursor.SkipSeparator();
  }
  if (ends == Ends::kClosed) builder.Close();
  result.offset = cursor.position();
  result.subpaths = std::move(builder).Take();
  return result;
}

}  // namespace lascaux::svg
