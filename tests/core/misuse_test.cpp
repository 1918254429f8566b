// What must not compile: sums of points, a point where a displacement is meant, the plane for
// space.
#include <concepts>
#include <type_traits>

#include "keyline/core/angle.h"
#include "keyline/core/error.h"
#include "keyline/core/point.h"

namespace keyline::core {
namespace {

template <class A, class B>
concept Addable = requires(A a, B b) { a + b; };
template <class A, class B>
concept Subtractable = requires(A a, B b) { a - b; };
template <class A, class B>
concept Dotted = requires(A a, B b) { dot(a, b); };
template <class A>
concept Scalable = requires(A a) { 2.0 * a; };
template <class A>
concept Normed = requires(A a) { norm(a); };

static_assert(Addable<Point2, Vector2> && !Addable<Point2, Point2> && !Addable<Vector2, Point2>);
static_assert(Addable<Point3, Vector3> && !Addable<Point3, Point3> && !Addable<Point2, Vector3>);
static_assert(Subtractable<Point2, Point2> && !Subtractable<Vector2, Point2>);
static_assert(Subtractable<Point3, Point3> && !Subtractable<Point3, Point2>);
static_assert(Dotted<Vector2, Vector2> && !Dotted<Point2, Vector2> && !Dotted<Vector2, Vector3>);
static_assert(Scalable<Vector2> && Scalable<Vector3> && !Scalable<Point2> && !Scalable<Point3>);
static_assert(Normed<Vector2> && !Normed<Point2>);
static_assert(!std::convertible_to<Point2, Vector2> && !std::convertible_to<Vector2, Point2>);
static_assert(!std::convertible_to<Point2, Point3> && !std::convertible_to<Vector3, Vector2>);
// an answer that may be none is no number until it is looked at
static_assert(!std::convertible_to<Result<double>, double>);

}  // namespace
}  // namespace keyline::core
