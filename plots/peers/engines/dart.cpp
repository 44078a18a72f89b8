// DART: jointed bodies are trees in reduced coordinates, so joints have no gaps. Contacts are rows, solved at once by
// Dantzig's pivoting, or by sweeps if that fails. ODE's functions find the contacts, since they support planes.
//
//   reduced   DART's only method
//
// A point mass on a rod is a body on a universal joint, with very small inertia. Loops are not supported here. A
// contact corrects a fifth of its overlap in each step, as in ODE; with DART's default of a hundredth bodies are
// deeper.
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>

#include <stdexcept>

#include "peers/engines/engine.hpp"

namespace spook::peers {

namespace {

using namespace dart::dynamics;

Eigen::Isometry3d moved(const Vec3& by) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = by;
  return T;
}

class Dart : public Engine {
 public:
  Dart(const Problem& problem, const Way& way) : problem_(problem), nodes_(problem.bodies.size(), nullptr) {
    world_->setGravity(problem.gravity);
    world_->setTimeStep(way.h);
    world_->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    dart::constraint::ContactConstraint::setErrorReductionParameter(0.2);
    dart::constraint::ContactConstraint::setMaxErrorReductionVelocity(1e3);
    for (std::size_t i = 0; i < problem.bodies.size(); ++i)
      if (!problem.bodies[i].moves) add_what_hangs_on(static_cast<int>(i), nullptr, nullptr);
    for (std::size_t i = 0; i < problem.bodies.size(); ++i)
      if (problem.bodies[i].moves && !nodes_[i]) add_free(static_cast<int>(i));
    for (const Plane& plane : problem.planes)
      add_fixed_shape(std::make_shared<PlaneShape>(plane.n, plane.offset), Vec3::Zero());
    for (const ProblemBody& body : problem.bodies)
      if (!body.moves && body.radius > 0) add_fixed_shape(std::make_shared<SphereShape>(body.radius), body.x);
    if (hung_ != problem.joints.size()) throw std::runtime_error("this adapter has no loops of joints");
  }

  void advance(std::int64_t steps) override {
    for (std::int64_t n = 0; n < steps; ++n) {
      if (problem_.friction > 0) follow_the_slip();
      world_->step();
      require_slow();
    }
  }
  Vec3 x(int body) const override {
    const BodyNode* node = nodes_[static_cast<std::size_t>(body)];
    return node ? Vec3(node->getWorldTransform().translation())
                : problem_.bodies[static_cast<std::size_t>(body)].x;
  }
  Quat q(int body) const override {
    const BodyNode* node = nodes_[static_cast<std::size_t>(body)];
    return node ? Quat(node->getWorldTransform().linear()) : Quat::Identity();
  }

 private:
  /// Creates a skeleton with a unique name, since DART prints a line for equal names.
  SkeletonPtr new_tree() { return Skeleton::create(std::to_string(trees_++)); }

  BodyNode::Properties properties(int body, bool point) const {
    const ProblemBody& it = problem_.bodies[static_cast<std::size_t>(body)];
    BodyNode::Properties made;
    made.mName = std::to_string(body);
    made.mInertia.setMass(it.mass);
    const Vec3 moments = point ? Vec3::Constant(1e-9 * it.mass) : it.principal;
    made.mInertia.setMoment(moments.x(), moments.y(), moments.z(), 0, 0, 0);
    return made;
  }

  void add_free(int body) {
    const ProblemBody& it = problem_.bodies[static_cast<std::size_t>(body)];
    const SkeletonPtr tree = new_tree();
    const auto made =
        tree->createJointAndBodyNodePair<FreeJoint>(nullptr, FreeJoint::Properties(), properties(body, false));
    Eigen::Isometry3d T = moved(it.x);
    T.linear() = it.q.toRotationMatrix();
    made.first->setPositions(FreeJoint::convertToPositions(T));
    put(body, made.second);
    add_what_hangs_on(body, tree, made.second);
    set_velocities(tree);
    world_->addSkeleton(tree);
  }

  void add_fixed_shape(const ShapePtr& shape, const Vec3& x) {
    const SkeletonPtr fixed = new_tree();
    const auto made = fixed->createJointAndBodyNodePair<WeldJoint>();
    made.first->setTransformFromParentBodyNode(moved(x));
    add_shape(made.second, shape);
    fixed->setMobile(false);
    world_->addSkeleton(fixed);
  }

  void add_shape(BodyNode* node, const ShapePtr& shape) {
    auto* const with = node->createShapeNodeWith<CollisionAspect, DynamicsAspect>(shape);
    with->getDynamicsAspect()->setFrictionCoeff(problem_.friction);
    with->getDynamicsAspect()->setFirstFrictionDirectionFrame(dart::dynamics::Frame::World());
    with->getDynamicsAspect()->setRestitutionCoeff(
        std::sqrt(problem_.restitution));  // DART multiplies the values of the two bodies
  }

  void put(int body, BodyNode* node) {
    const ProblemBody& it = problem_.bodies[static_cast<std::size_t>(body)];
    nodes_[static_cast<std::size_t>(body)] = node;
    if (it.radius > 0) add_shape(node, std::make_shared<SphereShape>(it.radius));
    if (!it.half_sides.isZero(0)) add_shape(node, std::make_shared<BoxShape>(2 * it.half_sides));
  }

  /// Throws Lost for huge or NaN velocities, because DART would end the program at a NaN soon afterwards.
  void require_slow() const {
    for (std::size_t k = 0; k < world_->getNumSkeletons(); ++k)
      if (!(world_->getSkeleton(k)->getVelocities().squaredNorm() < 1e12)) throw Lost();
  }

  /// Sets the first direction of the friction box to the velocity of a body.
  void follow_the_slip() {
    for (BodyNode* node : nodes_) {
      if (!node || node->getNumShapeNodes() == 0) continue;
      const Vec3 v = node->getLinearVelocity();
      if (v.norm() > 1e-6)
        node->getShapeNode(0)->getDynamicsAspect()->setFirstFrictionDirection(v.normalized());
    }
  }

  /// Adds the bodies without a node yet that joints connect to `body`. From a static body each of them starts a tree.
  void add_what_hangs_on(int body, const SkeletonPtr& tree, BodyNode* node) {
    for (const Joint& joint : problem_.joints) {
      if (joint.i != body && joint.j != body) continue;
      const bool first = joint.i == body;
      const int child = first ? joint.j : joint.i;
      if (!problem_.bodies[static_cast<std::size_t>(child)].moves || nodes_[static_cast<std::size_t>(child)])
        continue;
      const SkeletonPtr here = tree ? tree : new_tree();
      const Vec3 above = first ? joint.p_i : joint.p_j, below = first ? joint.p_j : joint.p_i;
      ++hung_;
      put(child,
          joint.length ? on_rod(*here, node, body, child) : on_ball(*here, node, body, child, above, below));
      add_what_hangs_on(child, here, nodes_[static_cast<std::size_t>(child)]);
      if (tree) continue;
      set_velocities(here);
      world_->addSkeleton(here);
    }
  }

  BodyNode* on_rod(Skeleton& tree, BodyNode* node, int body, int child) {
    const Vec3 from = problem_.bodies[static_cast<std::size_t>(body)].x;
    const Vec3 rod = problem_.bodies[static_cast<std::size_t>(child)].x - from;
    UniversalJoint::Properties joint;
    joint.mName = std::to_string(child);
    const Vec3 side = Vec3::UnitY() - rod.y() / rod.squaredNorm() * rod;
    joint.mAxis[0] = side.norm() > 0.1 ? Vec3(side.normalized()) : rod.cross(Vec3::UnitX()).normalized();
    joint.mAxis[1] = rod.cross(joint.mAxis[0]).normalized();
    joint.mT_ParentBodyToJoint = moved(node ? Vec3::Zero() : from);
    joint.mT_ChildBodyToJoint = moved(-rod);
    return tree.createJointAndBodyNodePair<UniversalJoint>(node, joint, properties(child, true)).second;
  }

  BodyNode* on_ball(Skeleton& tree, BodyNode* node, int body, int child, const Vec3& above, const Vec3& below) {
    const ProblemBody& from = problem_.bodies[static_cast<std::size_t>(body)];
    const Quat q = problem_.bodies[static_cast<std::size_t>(child)].q;
    BallJoint::Properties joint;
    joint.mName = std::to_string(child);
    joint.mT_ParentBodyToJoint = moved(node ? above : from.x + from.q * above);
    joint.mT_ChildBodyToJoint = moved(below);
    const auto made = tree.createJointAndBodyNodePair<BallJoint>(node, joint, properties(child, false));
    const Quat relative = node ? Quat(from.q.conjugate() * q) : q;
    made.first->setPositions(BallJoint::convertToPositions(relative.toRotationMatrix()));
    return made.second;
  }

  /// Sets joint velocities such that bodies have their initial velocities, as nearly as the joints allow.
  void set_velocities(const SkeletonPtr& tree) {
    const auto dofs = static_cast<Eigen::Index>(tree->getNumDofs());
    Eigen::MatrixXd J(0, dofs);
    Eigen::VectorXd wanted(0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!nodes_[i] || nodes_[i]->getSkeleton() != tree) continue;
      const ProblemBody& body = problem_.bodies[i];
      const bool turns = dynamic_cast<const UniversalJoint*>(nodes_[i]->getParentJoint()) == nullptr;
      const Eigen::Index row = J.rows(), rows = turns ? 6 : 3;
      J.conservativeResize(row + rows, dofs);
      wanted.conservativeResize(row + rows);
      J.middleRows(row, 3) = tree->getLinearJacobian(nodes_[i]);
      wanted.segment<3>(row) = body.v;
      if (!turns) continue;
      J.middleRows(row + 3, 3) = tree->getAngularJacobian(nodes_[i]);
      wanted.segment<3>(row + 3) = body.omega;
    }
    tree->setVelocities(J.colPivHouseholderQr().solve(wanted));
  }

  Problem problem_;
  std::vector<BodyNode*> nodes_;  // null for static bodies
  std::size_t hung_ = 0;          // number of joints in trees
  int trees_ = 0;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
};

}  // namespace

std::unique_ptr<Engine> make_dart(const Problem& problem, const Way& way) {
  return std::make_unique<Dart>(problem, way);
}

}  // namespace spook::peers
