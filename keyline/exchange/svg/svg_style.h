#pragma once

#include <cstddef>
#include <map>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::exchange::detail {

/// What of a drawing's style documents keep.
struct SvgPaint {
  std::string stroke;  ///< "#rrggbb"; empty: none, or a pattern
  std::string fill;
  double width = 1;                 ///< of the stroke, in px of its user space
  std::string current = "#000000";  ///< what currentColor means
  std::string unknown = {};        ///< of this element alone: what it gives as a colour and is none
  std::string unknown_width = {};  ///< likewise of the width of its stroke
  bool stroked = false;            ///< whether something is painted along its outline
  bool filled = true;              ///< or within it
  bool stroke_opaque = true, fill_opaque = true;  ///< not wholly transparent
  bool fixed_width = false;  ///< of this element alone: no transform changes that of its stroke
  bool cut_out = false;      ///< it or what is around it, by display or opacity: for all within
  bool visible = true;       ///< which what is within may say anew

  bool seen() const { return visible && !cut_out; }
  bool painted() const {
    return (stroked && stroke_opaque && width > 0) || (filled && fill_opaque);
  }

  /// What the element gives that is no colour or width, in words.
  std::vector<std::string> unread() const;

  /// The colour of an outline: of its stroke, else of what fills it.
  const std::string& color() const { return stroke.empty() ? fill : stroke; }
};

/// Style of elements: their attributes, then the rules of <style> for "*", their name, ".class",
/// "name.class" and "#id", in this order and within it in that of the sheets (others are let pass),
/// then their own style attribute, then what of the CSS is `!important`; CSS Cascading 4,
/// Selectors 4.
class SvgStyles {
 public:
  /// Takes the rules of a sheet; of very many the first 10,000.
  void add_sheet(std::string_view css);
  /// Takes those of a <style> element, its text and CDATA in one.
  void add_sheet(const pugi::xml_node& style);
  /// Rules let pass: of other selectors, with rules within them, @media and the like.
  std::size_t passed() const { return passed_; }
  /// Paint of an element within one that is painted as given.
  SvgPaint paint(const pugi::xml_node& node, SvgPaint inherited) const;
  /// Whether CSS turns, scales or shifts the element, or says about which place: its attribute
  /// `transform` then does not tell where it is.
  bool moves(const pugi::xml_node& node) const;
  /// Whether the element shows only what is within another.
  bool clips(const pugi::xml_node& node) const;

 private:
  void add_rule(std::string_view selectors, std::string_view body);

  /// Declarations of CSS that apply to the element, the strongest last.
  std::vector<std::string_view> declarations(const pugi::xml_node& node) const;

  /// Whether the element has one of these properties, by its attributes or in CSS.
  bool declares(const pugi::xml_node& node, std::span<const char* const> names) const;

  std::vector<std::string> bodies_;                        ///< of rules: their declarations
  std::map<std::string, std::vector<std::size_t>> rules_;  ///< those of a selector, in order
  std::size_t taken_ = 0;
  std::size_t passed_ = 0;
};

/// "#rrggbb" of a CSS colour: #rgb, #rrggbb, rgb(…), hsl(…) and all names; opacity is let pass.
/// Empty for what is no such colour.
std::string css_color(std::string_view text);

}  // namespace keyline::exchange::detail
