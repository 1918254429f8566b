#pragma once

namespace opencascade {
template <class T>
class handle;
}
class Interface_InterfaceModel;

namespace keyline::exchange::occt {

/// Writes out in an IGES model, before its shapes are made, what OCCT takes otherwise than IGES 5.3
/// has it: a matrix (124) placed by another becomes the product of both, and a conic (104) stands
/// on the x axis of a matrix of its own: an ellipse along it about the origin, a parabola and the
/// branch of a hyperbola opening to +x. Throws std::runtime_error for a matrix placed by itself.
void mend_iges_model(const opencascade::handle<Interface_InterfaceModel>& model);

}  // namespace keyline::exchange::occt
