#pragma once

#include <sstream>
#include <string>

#include "keyline/core/point.h"

namespace keyline::exchange {

inline std::string digits_of(double value) {
  std::ostringstream text;
  text.precision(17);
  text << std::showpoint << value;
  return text.str();
}

inline std::string point_text(core::Point3 p) {
  return "CARTESIAN_POINT('',(" + digits_of(p.x) + ',' + digits_of(p.y) + ',' + digits_of(p.z) +
         "));\n";
}

/// A STEP file in mm, written by hand after ISO 10303-21, -41 and -42: one product "part" whose
/// representation of that kind (without "_REPRESENTATION") holds these items. Entities from #20 on
/// are the body's; #14 are the axes x, y, z at the origin (#15), #18 is the direction z, #19 x, #16
/// y; #4 is the context.
inline std::string step_file(const std::string& kind, const std::string& items,
                             const std::string& body) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
         "FILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\n"
         "DATA;\n"
         "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
         "#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
         "#3=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n"
         "#4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1,#2,#3))"
         "REPRESENTATION_CONTEXT('',''));\n"
         "#5=APPLICATION_CONTEXT('');\n#6=PRODUCT_CONTEXT('',#5,'mechanical');\n"
         "#7=PRODUCT('part','part','',(#6));\n#8=PRODUCT_DEFINITION_FORMATION('','',#7);\n"
         "#9=PRODUCT_DEFINITION_CONTEXT('part definition',#5,'design');\n"
         "#10=PRODUCT_DEFINITION('design','',#8,#9);\n#11=PRODUCT_DEFINITION_SHAPE('','',#10);\n"
         "#12=SHAPE_DEFINITION_REPRESENTATION(#11,#13);\n#13=" +
         kind + "_REPRESENTATION('',(#14," + items +
         "),#4);\n#14=AXIS2_PLACEMENT_3D('',#15,#18,#19);\n#15=CARTESIAN_POINT('',(0.,0.,0.));\n"
         "#16=DIRECTION('',(0.,1.,0.));\n#18=DIRECTION('',(0.,0.,1.));\n"
         "#19=DIRECTION('',(1.,0.,0.));\n" +
         body + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// The same of curves by themselves, #21 on.
inline std::string step_curves(const std::string& curves, const std::string& body) {
  return step_file("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE", "#20",
                   "#20=GEOMETRIC_CURVE_SET('',(" + curves + "));\n" + body);
}

/// Entity n: a curve between two of its parameters.
inline std::string trimmed_text(int n, const std::string& curve, double from, double to) {
  return '#' + std::to_string(n) + "=TRIMMED_CURVE(''," + curve + ",(PARAMETER_VALUE(" +
         digits_of(from) + ")),(PARAMETER_VALUE(" + digits_of(to) + ")),.T.,.PARAMETER.);\n";
}

/// The same of faces.
inline std::string shell_text(const std::string& faces, const std::string& body) {
  return step_file(
      "MANIFOLD_SURFACE_SHAPE", "#20",
      "#20=SHELL_BASED_SURFACE_MODEL('',(#21));\n#21=OPEN_SHELL('',(" + faces + "));\n" + body);
}

}  // namespace keyline::exchange
