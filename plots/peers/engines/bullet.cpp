// Bullet in double precision: Debian's libraries whose names end in -float64.
//
//   sequential   btSequentialImpulseConstraintSolver: warm projected Gauss-Seidel with a given number of sweeps
//   dantzig      btMLCPSolver with btDantzigSolver: all rows at once, by pivoting on a dense matrix
//
// The margin around boxes is the smallest possible, since gaps are measured. Friction follows the slip, with two
// directions. In bouncing scenes contacts start at touch, and positions correct every overlap: by default a ball stops
// 2 cm too early, and its overlap throws it out, so peaks are wrong by a quarter at any step. In resting scenes the
// defaults are better: with the settings for bouncing, a tower of twenty boxes falls.
// Bullet has no distance between two points, so this file defines that row as a constraint in Bullet's form.
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>

#include "peers/engines/engine.hpp"

namespace spook::peers {

namespace {

btVector3 bullet(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
Vec3 ours(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// A distance between two centres: |x_j - x_i| = length.
class Rod : public btTypedConstraint {
 public:
  Rod(btRigidBody& i, btRigidBody& j, double length)
      : btTypedConstraint(CONTACT_CONSTRAINT_TYPE, i, j), length_(length) {}
  void getInfo1(btConstraintInfo1* info) override {
    info->m_numConstraintRows = 1;
    info->nub = 5;
  }
  void getInfo2(btConstraintInfo2* info) override {
    const btVector3 between = m_rbB.getWorldTransform().getOrigin() - m_rbA.getWorldTransform().getOrigin();
    const btVector3 n = between.normalized();
    for (int axis = 0; axis < 3; ++axis) {
      info->m_J1linearAxis[axis] = n[axis];
      info->m_J2linearAxis[axis] = -n[axis];
      info->m_J1angularAxis[axis] = info->m_J2angularAxis[axis] = 0;
    }
    info->m_constraintError[0] = info->fps * info->erp * (between.length() - length_);
  }
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

 private:
  double length_;
};

class Bullet : public Engine {
 public:
  Bullet(const Problem& problem, const Way& way) : h_(way.h) {
    dispatcher_ = std::make_unique<btCollisionDispatcher>(&configuration_);
    if (way.solver == "dantzig")
      solver_ = std::make_unique<btMLCPSolver>(&dantzig_);
    else
      solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
    world_ =
        std::make_unique<btDiscreteDynamicsWorld>(dispatcher_.get(), &pairs_, solver_.get(), &configuration_);
    world_->setGravity(bullet(problem.gravity));
    btContactSolverInfo& settings = world_->getSolverInfo();
    settings.m_numIterations = std::max(1, way.sweeps);
    settings.m_restitutionVelocityThreshold = problem.threshold;
    settings.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    if (problem.restitution > 0) settings.m_splitImpulsePenetrationThreshold = 0;
    if (way.solver == "dantzig") settings.m_minimumSolverBatchSize = 1;
    for (const ProblemBody& body : problem.bodies) add_body(body, problem);
    for (const Plane& plane : problem.planes) set_plane(plane);
    for (const auto& body : bodies_) world_->addRigidBody(body.get());
    for (const Joint& joint : problem.joints) add_joint(joint);
  }
  ~Bullet() override {
    for (const auto& joint : joints_) world_->removeConstraint(joint.get());
    for (const auto& body : bodies_) world_->removeRigidBody(body.get());
  }
  Bullet(const Bullet&) = delete;
  Bullet& operator=(const Bullet&) = delete;

  void advance(std::int64_t steps) override {
    for (std::int64_t n = 0; n < steps; ++n) world_->stepSimulation(h_, 0);
  }
  Vec3 x(int body) const override { return ours(transform(body).getOrigin()); }
  Quat q(int body) const override {
    const btQuaternion q = transform(body).getRotation();
    return Quat(q.w(), q.x(), q.y(), q.z());
  }

 private:
  const btTransform& transform(int body) const {
    return bodies_[static_cast<std::size_t>(body)]->getWorldTransform();
  }

  void add_body(const ProblemBody& body, const Problem& problem) {
    if (body.radius > 0) {
      shapes_.push_back(std::make_unique<btSphereShape>(body.radius));
    } else if (!body.half_sides.isZero(0)) {
      shapes_.push_back(std::make_unique<btBoxShape>(bullet(body.half_sides)));
      shapes_.back()->setMargin(1e-3 * body.half_sides.minCoeff());
    } else {
      shapes_.push_back(std::make_unique<btEmptyShape>());
    }
    btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, shapes_.back().get(),
                                                  bullet(body.principal));
    info.m_startWorldTransform =
        btTransform(btQuaternion(body.q.x(), body.q.y(), body.q.z(), body.q.w()), bullet(body.x));
    // Bullet multiplies the values of the two bodies.
    info.m_friction = std::sqrt(problem.friction);
    info.m_restitution = std::sqrt(problem.restitution);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setLinearVelocity(bullet(body.v));
    bodies_.back()->setAngularVelocity(bullet(body.omega));
    if (problem.restitution > 0) bodies_.back()->setContactProcessingThreshold(0);
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
  }
  void set_plane(const Plane& plane) {
    const auto body = static_cast<std::size_t>(plane.body);
    shapes_.push_back(std::make_unique<btStaticPlaneShape>(bullet(plane.n), plane.offset));
    bodies_[body]->setCollisionShape(shapes_.back().get());
    bodies_[body]->setWorldTransform(btTransform::getIdentity());  // the origin of the joint's offset
  }
  void add_joint(const Joint& joint) {
    btRigidBody &i = *bodies_[static_cast<std::size_t>(joint.i)],
                &j = *bodies_[static_cast<std::size_t>(joint.j)];
    if (joint.length)
      joints_.push_back(std::make_unique<Rod>(i, j, *joint.length));
    else
      joints_.push_back(std::make_unique<btPoint2PointConstraint>(i, j, bullet(joint.p_i), bullet(joint.p_j)));
    world_->addConstraint(joints_.back().get(), true);
  }

  double h_;
  btDefaultCollisionConfiguration configuration_;
  btDbvtBroadphase pairs_;
  btDantzigSolver dantzig_;
  std::unique_ptr<btCollisionDispatcher> dispatcher_;
  std::unique_ptr<btConstraintSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet(const Problem& problem, const Way& way) {
  return std::make_unique<Bullet>(problem, way);
}

}  // namespace spook::peers
