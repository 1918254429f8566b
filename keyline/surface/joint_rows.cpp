#include "keyline/surface/joint_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>

namespace keyline::surface::detail {

using Eigen::Index;
using Eigen::MatrixX3d;
using Eigen::RowVector3d;

JointRows::JointRows(std::span<const JointEquations> joints, const MatrixX3d& given, double unit,
                     JointMultipliers multipliers) {
  for (const JointEquations& joint : joints) {
    const bool open = multipliers == JointMultipliers::open && joint.meets;
    const std::size_t first = multipliers_.size();
    if (open)
      multipliers_.insert(multipliers_.end(), joint.multipliers.begin(), joint.multipliers.end());
    for (const JointForm& form : joint.forms) {
      const Form now = form.at(joint.multipliers);
      double square = 0;
      for (const auto& [i, w] : now) square += w * w;
      if (!(square > 0)) continue;
      add(open ? form : JointForm{{{kNoFactor, now}}}, first, std::sqrt(square) * unit, given);
    }
  }
  std::vector<double> squares(multipliers_.size(), 0);
  for (std::size_t c = 0; c < count(); ++c)
    for (const auto& [m, by] : at(c, given).multipliers)
      squares[static_cast<std::size_t>(m)] += by.squaredNorm();
  for (const double square : squares) weights_.push_back(std::sqrt(square));
}

void JointRows::add(const JointForm& form, std::size_t first, double unit, const MatrixX3d& given) {
  std::map<Index, Index> place;
  for (const auto& [factors, sum] : form.terms)
    for (const auto& [i, w] : sum) place.emplace(i, 0);
  Condition c;
  for (auto& [i, at] : place) {
    at = static_cast<Index>(c.points.size());
    c.points.push_back(i);
  }
  c.weights = Eigen::MatrixXd::Zero(static_cast<Index>(form.terms.size()),
                                    static_cast<Index>(c.points.size()));
  for (Factors factors : std::views::keys(form.terms)) {
    const auto row = static_cast<Index>(c.factors.size());
    for (const auto& [i, w] : form.terms[c.factors.size()].second)
      c.weights(row, place[i]) = w / unit;
    for (int& f : factors)
      if (f >= 0) f += static_cast<int>(first);
    c.factors.push_back(factors);
  }
  c.given = products_of(c) * values_of(c, given);
  conditions_.push_back(std::move(c));
}

MatrixX3d JointRows::values_of(const Condition& c, const MatrixX3d& x) const {
  MatrixX3d points(static_cast<Index>(c.points.size()), 3);
  for (std::size_t i = 0; i < c.points.size(); ++i)
    points.row(static_cast<Index>(i)) = x.row(c.points[i]);
  return c.weights * points;
}

Eigen::RowVectorXd JointRows::products_of(const Condition& c) const {
  Eigen::RowVectorXd products(static_cast<Index>(c.factors.size()));
  for (std::size_t t = 0; t < c.factors.size(); ++t)
    products[static_cast<Index>(t)] = value_of(c.factors[t], multipliers_);
  return products;
}

JointRow JointRows::at(std::size_t condition, const MatrixX3d& x) const {
  const Condition& c = conditions_[condition];
  const MatrixX3d values = values_of(c, x);
  const Eigen::RowVectorXd products = products_of(c);
  JointRow row{products * values - c.given, {}, {}};
  const Eigen::RowVectorXd weights = products * c.weights;
  for (std::size_t i = 0; i < c.points.size(); ++i)
    row.points.emplace_back(c.points[i], weights[static_cast<Index>(i)]);
  const auto add = [&](int multiplier, const RowVector3d& by) {
    if (multiplier < 0) return;
    const auto known = std::ranges::find(row.multipliers, Index{multiplier},
                                         &std::pair<Index, RowVector3d>::first);
    if (known == row.multipliers.end())
      row.multipliers.emplace_back(multiplier, by);
    else
      known->second += by;
  };
  for (std::size_t t = 0; t < c.factors.size(); ++t) {
    const auto [i, j] = c.factors[t];
    const RowVector3d value = values.row(static_cast<Index>(t));
    add(i, value_of({j, -1}, multipliers_) * value);
    add(j, value_of({i, -1}, multipliers_) * value);
  }
  return row;
}

double JointRows::misfit(const MatrixX3d& x) const {
  double most = 0;
  for (const Condition& c : conditions_)
    if (c.factors.size() > 1)
      most = std::max(most, (products_of(c) * values_of(c, x) - c.given).norm());
  return most;
}

}  // namespace keyline::surface::detail
