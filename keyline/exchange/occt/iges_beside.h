#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

class IGESControl_Reader;
class IGESData_IGESEntity;
class TopoDS_Shape;

namespace keyline::exchange::occt {

/// What an IGES file, its shapes made, states of its curves and surfaces that these do not follow:
/// that they are not to be seen, or beside the drawing; parts of surfaces; scales.
class IgesBeside {
 public:
  explicit IgesBeside(IGESControl_Reader& reader);

  /// Whether a root is a curve in the parameters of a surface, which by itself is nowhere in space
  /// (IGES 5.3, 2.2.4.4.9.3).
  bool holds(const TopoDS_Shape& root) const;
  /// A line for each kind there was.
  void tell(std::vector<std::string>& lines) const;

 private:
  void take(const IGESData_IGESEntity& entity);

  std::set<const void*> in_parameters_;
  std::size_t unseen_ = 0;
  std::size_t annotation_ = 0;
  std::size_t construction_ = 0;
  std::size_t parts_ = 0;
  std::size_t scaled_ = 0;
  double scale_ = 1;  ///< of the model
};

}  // namespace keyline::exchange::occt
