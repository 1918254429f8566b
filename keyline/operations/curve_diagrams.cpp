#include "keyline/analysis/joint_diagrams.h"
#include "keyline/analysis/self_affinity.h"
#include "keyline/operations/diagram_shown.h"
#include "keyline/operations/paper_operations.h"

namespace keyline::operations {
namespace {

using core::Result;

constexpr int kAffinitySamples = 1001;

struct DiagramsRequest {
  std::vector<document::Path> curves;
  double noise = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&DiagramsRequest::curves>("the sections, in their order")
                            .count(1, 10'000)
                            .needed(),
                        core::field<&DiagramsRequest::noise>("standard deviation of their places")
                            .in("length")
                            .within(core::at_least(0)));
  }
};

/// A piece of monotone curvature, or a section as a whole.
struct VolumeShown {
  double length = 0;
  double volume = 0;
  double relative_volume = 0;
  LddcGraph lddc;
  static constexpr auto describe() {
    using Shown = VolumeShown;
    return core::fields(core::field<&Shown::length>("of it").in("length"),
                        core::field<&Shown::volume>("area over its chord").in("length^2"),
                        core::field<&Shown::relative_volume>("over the square of its length"),
                        core::field<&Shown::lddc>("logarithmic distribution diagram of curvature"));
  }
};

/// [Fairing] Fig. 7: what is left when the first half is cut off, laid over the whole.
struct SelfAffinityShown {
  double deviation = 0;
  double length_scale = 1;
  double radius_scale = 1;
  static constexpr auto describe() {
    using Affinity = SelfAffinityShown;
    return core::fields(
        core::field<&Affinity::deviation>(
            "root mean square between the log radii of parent and rest; 0: self-affine"),
        core::field<&Affinity::length_scale>("that lays the rest's length over its parent's"),
        core::field<&Affinity::radius_scale>("and its radii"));
  }
};

struct PieceShown {
  VolumeShown volume;
  std::optional<SelfAffinityShown> self_affinity;
  static constexpr auto describe() {
    return core::fields(core::flattened<&PieceShown::volume>(),
                        core::field<&PieceShown::self_affinity>(
                            "how far it is from self-affine; null for arcs and lines")
                            .null_if_empty());
  }
};

struct SectionShown {
  VolumeShown whole;
  std::vector<PieceShown> pieces;
  static constexpr auto describe() {
    return core::fields(core::flattened<&SectionShown::whole>(),
                        core::field<&SectionShown::pieces>("of monotone curvature, in order"));
  }
};

/// What the diagrams of all sections, or of one piece of each, say together.
struct JointShown {
  core::Interval x;
  core::Interval y;
  std::optional<double> agreement;
  static constexpr auto describe() {
    using Joint = JointShown;
    return core::fields(
        core::field<&Joint::x>("range of all C curves, log10 of radius over length"),
        core::field<&Joint::y>("log10 of the share of the length"),
        core::field<&Joint::agreement>(
            "share of the pairs whose order by distance AB, the paper's index, is that of their "
            "relative volumes; null where there are none to compare")
            .null_if_empty());
  }
};

struct DiagramsAnswer {
  std::vector<SectionShown> sections;
  JointShown joint;
  std::vector<JointShown> pieces;
  static constexpr auto describe() {
    using Answer = DiagramsAnswer;
    return core::fields(core::field<&Answer::sections>("one for each curve"),
                        core::field<&Answer::joint>("over all sections"),
                        core::field<&Answer::pieces>(
                            "over the first pieces, the second…, where all sections have as many"));
  }
};

/// One section as it is measured; its diagrams stay where they are.
struct Measured {
  analysis::Lddc diagram;
  analysis::CurveAnalysis analysis;
};

VolumeShown volume_shown(double length, double volume, const analysis::Lddc& diagram) {
  return {length, volume, volume / (length * length), shown(diagram)};
}

std::optional<SelfAffinityShown> affinity_of(const document::Path& curve, core::Interval t) {
  const analysis::CurveView view = analysis::view(curve);
  const auto found = analysis::self_affinity(
      analysis::sample_profile(view, analysis::ArcLengthTable(view), t, kAffinitySamples));
  if (!found) return std::nullopt;
  return SelfAffinityShown{found->deviation, found->length_scale, found->radius_scale};
}

SectionShown section_shown(const document::Path& curve, const Measured& m) {
  SectionShown section{volume_shown(m.analysis.length, m.analysis.volume, m.diagram), {}};
  for (const analysis::PieceAnalysis& piece : m.analysis.pieces)
    section.pieces.push_back(
        {volume_shown(piece.length, piece.volume, piece.lddc), affinity_of(curve, piece.extent.t)});
  return section;
}

JointShown joint_shown(const std::vector<analysis::SectionVolume>& sections) {
  const analysis::JointDiagrams joint = analysis::joint_diagrams(sections);
  return {joint.x, joint.y, joint.agreement};
}

/// Of the whole sections, then of their pieces as long as all have as many.
void add_joint(const std::vector<Measured>& all, DiagramsAnswer& answer) {
  std::vector<analysis::SectionVolume> whole;
  bool alike = true;
  for (std::size_t i = 0; i < all.size(); ++i) {
    whole.push_back({&all[i].diagram, answer.sections[i].whole.relative_volume});
    alike = alike && all[i].analysis.pieces.size() == all[0].analysis.pieces.size();
  }
  answer.joint = joint_shown(whole);
  for (std::size_t k = 0; alike && k < all[0].analysis.pieces.size(); ++k) {
    std::vector<analysis::SectionVolume> nth;
    for (std::size_t i = 0; i < all.size(); ++i)
      nth.push_back(
          {&all[i].analysis.pieces[k].lddc, answer.sections[i].pieces[k].volume.relative_volume});
    answer.pieces.push_back(joint_shown(nth));
  }
}

Result<DiagramsAnswer> run(const DiagramsRequest& request, const Context&) {
  std::vector<Measured> all;
  DiagramsAnswer answer;
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    auto found = analyze_path(request.curves[i], request.noise);
    if (!found) {
      core::Failure failure = found.error();
      failure.path = "curves[" + std::to_string(i) + "]";
      return std::unexpected(std::move(failure));
    }
    all.push_back({analysis::curvature_distribution_diagram(request.curves[i]), std::move(*found)});
    answer.sections.push_back(section_shown(request.curves[i], all.back()));
  }
  add_joint(all, answer);
  return answer;
}

}  // namespace

Operation curve_diagrams_operation() {
  return declare<run>(
      {.name = "curve.diagrams",
       .summary = "Logarithmic distribution diagrams of many sections read together: volume of "
                  "every section and of its pieces, how self-affine these are, all C curves in one "
                  "frame, and whether the "
                  "diagrams' index orders the sections as their volumes do.",
       .examples = {R"({"curves":[{"type":"bezier","points":[[0,0],[1,1],[3,1.2]]},
                                  {"type":"bezier","points":[[0,0],[1,1.2],[3,1.5]]}]})"},
       .long_running = true});
}

}  // namespace keyline::operations
