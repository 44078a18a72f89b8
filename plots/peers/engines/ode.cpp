// The Open Dynamics Engine in Debian's version: double precision.
//
//   step        dWorldStep: all rows at once, by Dantzig's pivoting on a dense matrix
//   quick       dWorldQuickStep: projected Gauss-Seidel with a given number of sweeps
//   quick 0.4   the same with an ERP of 0.4
//
// Normal forces limit friction (dContactApprox1), and its first direction follows the slip (dContactFDir1). The default
// friction box on fixed tangents has the same error along a diagonal as ours. CFM is as small as the factorisation
// allows. ERP, the fraction of an overlap that a step corrects, is 0.2 by default. An ERP of 0.8 gains nothing at rest,
// and shakes swinging bodies. In piles 0.4 leaves two thirds of the overlap, or loses the pile. A larger CFM,
// over-relaxation of 0.8 and 1, and a surface layer gain nothing there.
#include <ode/ode.h>

#include <array>
#include <cstdarg>
#include <stdexcept>

#include "peers/engines/engine.hpp"

namespace spook::peers {

namespace {

constexpr int most_contacts_of_a_pair = 8;

class Ode : public Engine {
 public:
  Ode(const Problem& problem, const Way& way)
      : problem_(problem), h_(way.h), quick_(way.solver != "step"), world_(dWorldCreate()) {
    dRandSetSeed(1);  // seed of the row order of quick
    space_ = problem.bodies.size() > 100 ? dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)
                                         : dSimpleSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, problem.gravity.x(), problem.gravity.y(), problem.gravity.z());
    dWorldSetCFM(world_, 1e-12);
    if (way.solver == "quick 0.4") dWorldSetERP(world_, 0.4);
    dWorldSetQuickStepNumIterations(world_, std::max(1, way.sweeps));
    for (const ProblemBody& body : problem.bodies) bodies_.push_back(body.moves ? moving(body) : nullptr);
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) add_shape(problem.bodies[i], bodies_[i]);
    for (const Plane& plane : problem.planes)
      dCreatePlane(space_, plane.n.x(), plane.n.y(), plane.n.z(), plane.offset);
    for (const Joint& joint : problem.joints) add_joint(joint);
  }
  ~Ode() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  Ode(const Ode&) = delete;
  Ode& operator=(const Ode&) = delete;

  void advance(std::int64_t steps) override {
    for (std::int64_t n = 0; n < steps; ++n) {
      dSpaceCollide(space_, this,
                    [](void* self, dGeomID a, dGeomID b) { static_cast<Ode*>(self)->touch(a, b); });
      if (quick_)
        dWorldQuickStep(world_, h_);
      else
        dWorldStep(world_, h_);
      dJointGroupEmpty(contacts_);
    }
  }
  Vec3 x(int body) const override {
    const dBodyID it = bodies_[static_cast<std::size_t>(body)];
    if (!it) return problem_.bodies[static_cast<std::size_t>(body)].x;
    return Vec3(dBodyGetPosition(it)[0], dBodyGetPosition(it)[1], dBodyGetPosition(it)[2]);
  }
  Quat q(int body) const override {
    const dBodyID it = bodies_[static_cast<std::size_t>(body)];
    if (!it) return Quat::Identity();
    const dReal* q = dBodyGetQuaternion(it);
    return Quat(q[0], q[1], q[2], q[3]);
  }

 private:
  dBodyID moving(const ProblemBody& body) {
    const dBodyID it = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, body.mass, 0, 0, 0, body.principal.x(), body.principal.y(), body.principal.z(), 0,
                       0, 0);
    dBodySetMass(it, &mass);
    dBodySetPosition(it, body.x.x(), body.x.y(), body.x.z());
    const dQuaternion q = {body.q.w(), body.q.x(), body.q.y(), body.q.z()};
    dBodySetQuaternion(it, q);
    dBodySetLinearVel(it, body.v.x(), body.v.y(), body.v.z());
    dBodySetAngularVel(it, body.omega.x(), body.omega.y(), body.omega.z());
    dBodySetAutoDisableFlag(it, 0);
    return it;
  }

  void add_shape(const ProblemBody& body, dBodyID it) {
    dGeomID shape = nullptr;
    if (body.radius > 0)
      shape = dCreateSphere(space_, body.radius);
    else if (!body.half_sides.isZero(0))
      shape = dCreateBox(space_, 2 * body.half_sides.x(), 2 * body.half_sides.y(), 2 * body.half_sides.z());
    if (!shape) return;
    if (it)
      dGeomSetBody(shape, it);
    else
      dGeomSetPosition(shape, body.x.x(), body.x.y(), body.x.z());
  }

  void add_joint(const Joint& joint) {
    const auto at = [&](int body, const Vec3& p) -> Vec3 {
      const ProblemBody& it = problem_.bodies[static_cast<std::size_t>(body)];
      return it.x + it.q * p;
    };
    const Vec3 i = at(joint.i, joint.p_i), j = at(joint.j, joint.p_j);
    const dBodyID a = bodies_[static_cast<std::size_t>(joint.i)],
                  b = bodies_[static_cast<std::size_t>(joint.j)];
    if (joint.length) {
      const dJointID rod = dJointCreateDBall(world_, nullptr);
      dJointAttach(rod, a, b);
      dJointSetDBallAnchor1(rod, i.x(), i.y(), i.z());
      dJointSetDBallAnchor2(rod, j.x(), j.y(), j.z());
      dJointSetDBallDistance(rod, *joint.length);
    } else {
      const dJointID ball = dJointCreateBall(world_, nullptr);
      dJointAttach(ball, a, b);
      dJointSetBallAnchor(ball, i.x(), i.y(), i.z());
    }
  }

  /// Adds a contact joint for each point at which two shapes touch.
  void touch(dGeomID a, dGeomID b) {
    const dBodyID i = dGeomGetBody(a), j = dGeomGetBody(b);
    if (!i && !j) return;
    std::array<dContact, most_contacts_of_a_pair> points;
    const int count = dCollide(a, b, most_contacts_of_a_pair, &points[0].geom, sizeof(dContact));
    for (int c = 0; c < count; ++c) {
      dContact& point = points[static_cast<std::size_t>(c)];
      point.surface = {};
      point.surface.mode = dContactApprox1 | dContactBounce;
      point.surface.mu = problem_.friction;
      point.surface.bounce = problem_.restitution;
      point.surface.bounce_vel = problem_.threshold;
      if (problem_.friction > 0) follow_the_slip(point, i, j);
      dJointAttach(dJointCreateContact(world_, contacts_, &point), i, j);
    }
  }

  static Vec3 velocity(dBodyID body, const dReal* point) {
    if (!body) return Vec3::Zero();
    dVector3 v;
    dBodyGetPointVel(body, point[0], point[1], point[2], v);
    return Vec3(v[0], v[1], v[2]);
  }
  static void follow_the_slip(dContact& point, dBodyID i, dBodyID j) {
    const Vec3 n(point.geom.normal[0], point.geom.normal[1], point.geom.normal[2]);
    const Vec3 v = velocity(i, point.geom.pos) - velocity(j, point.geom.pos);
    const Vec3 slip = v - v.dot(n) * n;
    if (slip.norm() < 1e-6) return;
    point.surface.mode |= dContactFDir1;
    for (int axis = 0; axis < 3; ++axis) point.fdir1[axis] = slip[axis] / slip.norm();
  }

  Problem problem_;
  double h_;
  bool quick_;
  dWorldID world_;
  dSpaceID space_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  std::vector<dBodyID> bodies_;  // null for static bodies
};

}  // namespace

std::unique_ptr<Engine> make_ode(const Problem& problem, const Way& way) {
  // ODE's messages report failed factorisations; the consequences are visible in the error.
  dSetMessageHandler([](int, const char*, va_list) {});
  static const bool ready = dInitODE2(0) != 0 && dCheckConfiguration("ODE_double_precision") != 0;
  if (!ready) throw std::runtime_error("this ODE is not of double precision");
  return std::make_unique<Ode>(problem, way);
}

}  // namespace spook::peers
