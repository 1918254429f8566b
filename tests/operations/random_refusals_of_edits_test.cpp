#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "random_patches.h"

/// Refusals of surface.edit where conditions are given, held against a search of another kind (see
/// random_refusals_test.cpp): angles and ratios of edges as equations, the place within the ranges
/// an unknown of each curve, Levenberg and Marquardt's steps from many starts.
namespace keyline::operations {
namespace {

using namespace own;

using Points = std::array<Vec, 16>;

struct Asked {
  int curve = 0;                                     ///< 0 to 3: rows, 4 to 7: columns
  double turn[2] = {0, 1.09}, growth[2] = {0, 1.6};  ///< growth: ln s
  bool falls = false;                                ///< its edges, from the first point on
};

struct Problem {
  Points given;
  std::vector<int> free;
  std::vector<Asked> asked;
  double size = 1;
};

std::array<Vec, 3> edges(const Points& p, int curve) {
  const int first = curve < 4 ? 4 * curve : curve - 4, step = curve < 4 ? 1 : 4;
  std::array<Vec, 3> e;
  for (int i = 0; i < 3; ++i) e[i] = p[first + (i + 1) * step] - p[first + i * step];
  return e;
}

double within(const double range[2], double unknown) {
  return std::lerp(range[0], range[1], 0.5 - 0.5 * std::cos(unknown));
}

Points points_at(const Problem& q, const std::vector<double>& x) {
  Points p = q.given;
  for (std::size_t i = 0; i < q.free.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) p[q.free[i]][k] += q.size * x[3 * i + k];
  return p;
}

/// Six for each curve: both ratios, both angles, one plane, one way round in it.
std::vector<double> off(const Problem& q, const std::vector<double>& x) {
  const Points p = points_at(q, x);
  std::vector<double> r;
  for (std::size_t c = 0; c < q.asked.size(); ++c) {
    const Asked& a = q.asked[c];
    const double turn = within(a.turn, x[3 * q.free.size() + 2 * c]);
    const double growth = (a.falls ? -1 : 1) * within(a.growth, x[3 * q.free.size() + 2 * c + 1]);
    const auto e = edges(p, a.curve);
    const Vec m = cross(e[0], e[1]), n = cross(e[1], e[2]);
    for (int i = 0; i < 2; ++i) {
      r.push_back(std::log(size(e[i + 1]) / size(e[i])) - growth);
      r.push_back(std::atan2(size(cross(e[i], e[i + 1])), dot(e[i], e[i + 1])) - turn);
    }
    const Vec apart = (1 / (size(m) + 1e-12)) * m - (1 / (size(n) + 1e-12)) * n;
    for (std::size_t k = 0; k < 3; ++k) r.push_back(turn < 1e-6 ? 0 : apart[k]);
  }
  return r;
}

double square(const std::vector<double>& r) {
  double sum = 0;
  for (const double v : r) sum += v * v;
  return sum;
}

/// Gauss's elimination with pivots.
std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t best = c;
    for (std::size_t i = c; i < n; ++i)
      if (std::abs(a[i][c]) > std::abs(a[best][c])) best = i;
    std::swap(a[c], a[best]);
    std::swap(b[c], b[best]);
    for (std::size_t i = c + 1; i < n; ++i) {
      const double f = a[i][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[i][k] -= f * a[c][k];
      b[i] -= f * b[c];
    }
  }
  for (std::size_t c = n; c-- > 0;) {
    for (std::size_t k = c + 1; k < n; ++k) b[c] -= a[c][k] * b[k];
    b[c] /= a[c][c];
  }
  return b;
}

/// Levenberg and Marquardt's steps, (J J' + mu) y = r: few equations, many unknowns.
bool settles(const Problem& q, std::vector<double>& x) {
  std::vector<double> r = off(q, x);
  double mu = 1e-2;
  for (int step = 0; step < 80 && square(r) > 1e-22; ++step) {
    std::vector<std::vector<double>> by(x.size());
    for (std::size_t j = 0; j < x.size(); ++j) {
      std::vector<double> near = x;
      near[j] += 1e-7;
      by[j] = off(q, near);
      for (std::size_t i = 0; i < r.size(); ++i) by[j][i] = (by[j][i] - r[i]) / 1e-7;
    }
    bool better = false;
    for (; !better && mu < 1e6; mu *= better ? 0.1 : 10) {
      std::vector<std::vector<double>> a(r.size(), std::vector<double>(r.size()));
      for (std::size_t i = 0; i < r.size(); ++i)
        for (std::size_t k = 0; k < r.size(); ++k) {
          for (const auto& column : by) a[i][k] += column[i] * column[k];
          if (i == k) a[i][k] += mu;
        }
      const std::vector<double> y = solved(a, r);
      std::vector<double> next = x;
      for (std::size_t j = 0; j < x.size(); ++j)
        for (std::size_t i = 0; i < r.size(); ++i) next[j] -= by[j][i] * y[i];
      const std::vector<double> after = off(q, next);
      better = square(after) < square(r);
      if (!better) continue;
      x = next;
      r = after;
    }
    if (!better) break;
  }
  return square(r) < 1e-18;
}

json as_net(const Points& p) {
  json net = json::array();
  for (std::size_t i = 0; i < 4; ++i) {
    json row = json::array();
    for (std::size_t j = 0; j < 4; ++j)
      row.push_back({p[4 * i + j][0], p[4 * i + j][1], p[4 * i + j][2]});
    net.push_back(row);
  }
  return {{"type", "bezier-surface"}, {"points", net}};
}

/// The patch that is found faces as the given one, everywhere.
bool faces_as(const json& given, const json& found) {
  const Patches a = patches_of(given), b = patches_of(found);
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 12; ++j) {
      const SurfaceSpot s = spot(a.patches[0], i / 12.0, j / 12.0);
      const SurfaceSpot t = spot(b.patches[0], i / 12.0, j / 12.0);
      if (!(dot(cross(s.u, s.v), cross(t.u, t.v)) > 0)) return false;
    }
  return true;
}

bool finds_net(Problem q, Random& random) {
  constexpr int kStarts = 12;
  for (int n = 0; n < kStarts; ++n) {
    for (Asked& a : q.asked) {
      const auto e = edges(q.given, a.curve);
      a.falls = n < kStarts / 2 ? size(e[2]) < size(e[0]) : random() % 2 == 0;
    }
    std::vector<double> x(3 * q.free.size() + 2 * q.asked.size());
    for (double& v : x) v = n == 0 ? 0 : 0.1 * uniform(random, -1, 1);
    for (std::size_t i = 3 * q.free.size(); i < x.size(); ++i) x[i] = uniform(random, 0.5, 2.6);
    if (!settles(q, x)) continue;
    if (faces_as(as_net(q.given), as_net(points_at(q, x)))) return true;
  }
  return false;
}

struct Drawn {
  json request;
  Problem problem;
};

/// A patch with the boundary or the corners kept, and ranges for one to three of its curves.
Drawn any_drawn(Random& random) {
  Drawn d;
  const json patch = any_patch(random, 4, 4, std::array{0.03, 0.1, 0.3, 0.5}[random() % 4]);
  const bool boundary = random() % 2 == 0;
  d.request = {{"op", "surface.edit"},
               {"surface", patch},
               {"keep", boundary ? "boundary" : "corners"},
               {"conditions", json::array()}};
  d.problem.size = net_extent(patch);
  for (int i = 0; i < 16; ++i) {
    d.problem.given[i] = vec(patch["points"][i / 4][i % 4]);
    const bool row = i / 4 == 0 || i / 4 == 3, column = i % 4 == 0 || i % 4 == 3;
    if (boundary ? !row && !column : !row || !column) d.problem.free.push_back(i);
  }
  std::vector<int> curves{0, 1, 2, 3, 4, 5, 6, 7};
  if (boundary) curves = {1, 2, 5, 6};
  std::ranges::shuffle(curves, random);
  curves.resize(1 + random() % 3);
  for (const int c : curves) {
    Asked a{.curve = c};
    json condition{{"curve", "A" + std::to_string(c + 1)}};
    if (random() % 3 > 0) {
      a.turn[0] = uniform(random, 0.05, 0.6);
      a.turn[1] = a.turn[0] + uniform(random, 0.01, 0.3);
      condition["alpha"] = a.turn;
    }
    if (!condition.contains("alpha") || random() % 2 == 0) {
      const double s = uniform(random, 1.01, 1.8), more = s + uniform(random, 0.01, 0.4);
      a.growth[0] = std::log(s);
      a.growth[1] = std::log(more);
      condition["s"] = {s, more};
    }
    d.request["conditions"].push_back(condition);
    d.problem.asked.push_back(a);
  }
  return d;
}

TEST(RandomRefusals, NoNetOfTheConditionsIsFoundByAnglesAndRatios) {
  Random random(own::seed(48));
  const int wanted = own::refusals(8);
  int refused = 0, asked = 0, disagreed = 0, answered_ = 0, found = 0;
  for (; refused < wanted && asked < 60 * wanted; ++asked) {
    const Drawn d = any_drawn(random);
    SCOPED_TRACE(d.request.dump());
    const json answer = answered(d.request);
    if (answer["ok"] == true) {
      if (answered_ == 10) continue;
      ++answered_;
      found += finds_net(d.problem, random);
      continue;
    }
    ASSERT_EQ(answer["error"]["code"], "undrawable") << answer;
    ++refused;
    if (!finds_net(d.problem, random)) continue;
    ++disagreed;
    std::cout << "found: " << d.request << '\n' << answer["error"]["message"] << '\n';
  }
  RecordProperty("asked", std::to_string(asked));
  RecordProperty("refused", std::to_string(refused));
  RecordProperty("disagreed", std::to_string(disagreed));
  // Of patches so disturbed that most nets turn over a few are missed (docs/accuracy.md).
  EXPECT_LE(disagreed, std::max(1, wanted / 16));
  EXPECT_GE(found, answered_ / 2);
}

Points points_of(const json& surface) {
  Points net;
  for (std::size_t i = 0; i < 16; ++i) net[i] = vec(surface["points"][i / 4][i % 4]);
  return net;
}

void expect_one_matrix(const Points& net, int curve, const double (&range)[2]) {
  const auto e = edges(net, curve);
  for (int i = 0; i < 2; ++i) {
    const double turn = std::atan2(size(cross(e[i], e[i + 1])), dot(e[i], e[i + 1]));
    EXPECT_GT(turn, range[0] - 1e-8);
    EXPECT_LT(turn, range[1] + 1e-8);
  }
  EXPECT_NEAR(size(e[2]) / size(e[1]), size(e[1]) / size(e[0]), 1e-8);
}

/// Of the nets nearest to this one, in each of its valleys, the normal turns over; of another that
/// meets the ranges too it does not.
TEST(RandomRefusals, ANetThatDoesNotTurnOverIsFound) {
  const json request = json::parse(R"({"op":"surface.edit","keep":"corners","conditions":[
    {"curve":"A4","alpha":[0.5312945829888092,0.8016528048862832]},
    {"curve":"A6","alpha":[0.2344642391977751,0.41260872330089404]}],
    "surface":{"type":"bezier-surface","points":[[[4.584204796312008,-6.4375646563480196,6.569314366161633],
    [5.776791348237151,-5.174338006738296,6.665572907348272],
    [5.937527834838835,-2.1700223702624966,7.210290011381533],
    [3.6376934647262944,2.456941484200552,7.382620090797284]],
    [[7.2466440751095895,-5.96873159677379,6.911747412876203],
    [9.045438717745315,-4.62979694639706,5.720000464897087],
    [7.131200141383866,0.0855683538605347,5.6391984778358175],
    [7.928922171579716,1.6343866556358444,6.241154459598916]],
    [[9.68766667254502,-7.102393724953521,7.706425060866332],
    [9.308513686545902,-2.4212302140632325,6.563093016845628],
    [9.831486509156965,0.4530867368882133,7.591378232181792],
    [11.739825089073848,2.2126328304950404,5.316688998852638]],
    [[12.620252559973004,-6.258625529243605,6.8045960609948954],
    [14.886345810160927,-4.230926055678636,8.007386731579558],
    [12.57330905856718,0.35216638063343797,5.303312151021645],
    [12.357033084183772,0.7186484764981786,5.613976981326738]]]}})");
  const json result = result_of(request);
  const Points net = points_of(result["surface"]);
  expect_one_matrix(net, 3, {0.5312945829888092, 0.8016528048862832});
  expect_one_matrix(net, 5, {0.2344642391977751, 0.41260872330089404});
  EXPECT_TRUE(faces_as(request["surface"], result["surface"]));
}

/// A net far from the given one, which ways from there did not lead to. Ranges are measured at the
/// edges that come back.
TEST(RandomRefusals, ANetFarFromTheGivenOneIsFound) {
  const json points = {{{11.360773831551768, -9.35718884233174, -3.97573547301237},
                        {11.583044178054061, -5.553238927928047, -3.8057827473604573},
                        {11.100543664437192, -2.206134706356008, -3.756489444943138},
                        {11.307705385159267, 1.8307843509092738, -3.692916910373249}},
                       {{14.970749093685706, -9.593010033395341, -3.656426125299122},
                        {15.528206418411992, -5.623141104384918, -3.920360601570779},
                        {15.38800204507258, -1.9180576559710716, -3.532608065438561},
                        {15.0259633672827, 2.215090716412288, -2.7629323480116645}},
                       {{18.868279060033284, -9.882412295032477, -4.4032761677193815},
                        {19.029125105255225, -5.658708047703938, -3.5696423406273157},
                        {18.99899344837477, -1.6387665709105919, -3.4191103436079433},
                        {19.233443154589327, 2.0099375082461317, -3.1903617885174995}},
                       {{22.478818804934342, -9.249080384390936, -4.536403583751999},
                        {22.529438136276013, -6.007200571014941, -3.939556246386201},
                        {22.531723063684407, -1.9053816668069048, -3.7468985281438854},
                        {23.079761754944766, 2.007306730734817, -3.20058325810331}}};
  const double turns[2][2] = {{0.30828153255666224, 0.46976953040584046},
                              {0.5407670037212604, 0.7837545269945437}};
  const double scales[2] = {1.3997359081913994, 1.5983927698868226};
  const json result = result_of({{"op", "surface.edit"},
                                 {"surface", {{"type", "bezier-surface"}, {"points", points}}},
                                 {"keep", "boundary"},
                                 {"conditions",
                                  {{{"curve", "A6"}, {"alpha", turns[0]}},
                                   {{"curve", "A3"}, {"alpha", turns[1]}, {"s", scales}}}}});
  const Points net = points_of(result["surface"]);
  expect_one_matrix(net, 5, turns[0]);
  expect_one_matrix(net, 2, turns[1]);
  const auto e = edges(net, 2);
  const double ratio = size(e[1]) / size(e[0]), s = std::max(ratio, 1 / ratio);
  EXPECT_GT(s, scales[0] - 1e-8);
  EXPECT_LT(s, scales[1] + 1e-8);
}

}  // namespace
}  // namespace keyline::operations
