#pragma once

namespace opencascade {
template <class T>
class handle;
}
class Interface_InterfaceModel;

namespace keyline::exchange::occt {

/// Writes out in a STEP model, before its shapes are made, what OCCT takes otherwise than
/// ISO 10303-42 has it: directions that a placement leaves out (build_axes, first_proj_axis), and
/// the parameters of parabolas, C + f (u^2 x + 2 u y), which become points.
void mend_step_model(const opencascade::handle<Interface_InterfaceModel>& model);

}  // namespace keyline::exchange::occt
