#include "02_quaternions/quaternions.hpp"
#include "common/require.hpp"

namespace spook {

void step_free(Simulation& simulation, double h) {
  require_positive("h", h);
  for (RigidBody& body : simulation.bodies) {
    if (body.mass == 0) continue;
    body.v = kick(body.v, body.mass * simulation.gravity, 1 / body.mass, h);  // Eq. (1.3)
    body.x = drift(body.x, body.v, h);                                        // Eq. (1.4)

    const Vec3& I = body.principal;
    if (I == Vec3::Zero()) continue;
    if (I.x() == I.y() && I.y() == I.z())
      body.q = update_exponential(body.q, body.omega, h);  // Eq. (2.6)
    else
      free_rotation(body.q, body.omega, I, h);  // Eq. (2.11)
  }
}

}  // namespace spook
