// MuJoCo, by its C API: jointed bodies are trees in reduced coordinates, contacts and loops are soft rows, all of them
// one convex problem in each step.
//
//   newton      Newton's method, with elliptic cones
//   pyramids    Newton's method, with four-sided pyramids in place of the cones
//   sweeps      projected Gauss-Seidel on elliptic cones, with a given number of sweeps
//
// Rows are as stiff as MuJoCo allows: a time constant of two steps, and an impedance of 0.9999 at any gap. With one that
// grows from 0.99 to 0.9999, two cubes at rest are thrown apart. Friction creeps by design; an impratio of 100 makes that
// a hundred times slower. There is no restitution. A point mass on a rod is a body on two hinges, with very small
// inertia. MuJoCo reads a model from a file, which is written and removed here.
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <Eigen/QR>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "peers/engines/engine.hpp"

namespace spook::peers {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x() << ' ' << v.y() << ' ' << v.z();
  return out.str();
}
std::string text(const Quat& q) {
  std::ostringstream out;
  out.precision(17);
  out << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z();
  return out.str();
}

/// Writes the model of a problem in MuJoCo's format.
class ModelText {
 public:
  ModelText(const Problem& problem, const Way& way)
      : problem_(problem), written_(problem.bodies.size(), false) {
    const std::size_t n = problem.bodies.size();
    out_.precision(17);
    out_ << "<mujoco><compiler inertiafromgeom=\"false\" angle=\"radian\"/>"
         << "<size njmax=\"" << 60 * n + 500 << "\" nconmax=\"" << 20 * n + 200 << "\" nstack=\""
         << 40000 * n + 4000000 << "\"/>"
         << "<option timestep=\"" << way.h << "\" gravity=\"" << text(problem.gravity) << "\" cone=\""
         << (way.solver == "pyramids" ? "pyramidal" : "elliptic") << "\" solver=\""
         << (way.solver == "sweeps" ? "PGS" : "Newton") << "\" iterations=\""
         << (way.solver == "sweeps" ? std::max(1, way.sweeps) : 100) << "\" tolerance=\"1e-12\" impratio=\""
         << (way.solver == "pyramids" ? 1 : 100) << "\"/>";
    const std::string stiff = "solref=\"" + std::to_string(2 * way.h) + " 1\" solimp=\"0.9999 0.9999 0.001\"";
    out_ << "<default><geom " << stiff << " condim=\"" << (problem.friction > 0 ? 3 : 1) << "\" friction=\""
         << problem.friction << " 0 0\"/><equality " << stiff << "/></default><worldbody>";
    for (const Plane& plane : problem.planes)
      out_ << "<geom type=\"plane\" size=\"0 0 1\" pos=\"" << text(Vec3(plane.offset * plane.n))
           << "\" zaxis=\"" << text(plane.n) << "\"/>";
    for (std::size_t i = 0; i < n; ++i)
      if (!problem.bodies[i].moves) {
        add_shape(problem.bodies[i], text(problem.bodies[i].x));
        add_what_hangs_on(static_cast<int>(i));
      }
    for (std::size_t i = 0; i < n; ++i)
      if (problem.bodies[i].moves && !written_[i]) add_body(static_cast<int>(i), nullptr, -1);
    out_ << "</worldbody><equality>" << loops() << "</equality></mujoco>";
  }
  std::string all() const { return out_.str(); }

 private:
  const ProblemBody& body(int i) const { return problem_.bodies[static_cast<std::size_t>(i)]; }

  void add_shape(const ProblemBody& of, const std::string& position) {
    if (of.radius > 0)
      out_ << "<geom type=\"sphere\" size=\"" << of.radius << "\" pos=\"" << position << "\"/>";
    else if (!of.half_sides.isZero(0))
      out_ << "<geom type=\"box\" size=\"" << text(of.half_sides) << "\" pos=\"" << position << "\"/>";
  }

  /// Adds a body and its subtree: a free one, or one on a joint to `parent`.
  void add_body(int i, const Joint* joint, int parent) {
    const ProblemBody& of = body(i);
    written_[static_cast<std::size_t>(i)] = true;
    const bool nested = joint && body(parent).moves;
    const Quat back = nested ? Quat(body(parent).q.conjugate()) : Quat::Identity();
    const Vec3 x = nested ? Vec3(back * (of.x - body(parent).x)) : of.x;
    out_ << "<body name=\"b" << i << "\" pos=\"" << text(x) << "\" quat=\"" << text(Quat(back * of.q)) << "\">";
    if (joint)
      add_joint(*joint, i, parent);
    else
      out_ << "<freejoint/>";
    const Vec3 moments = joint && joint->length ? Vec3::Constant(1e-9 * of.mass) : of.principal;
    out_ << "<inertial pos=\"0 0 0\" mass=\"" << of.mass << "\" diaginertia=\"" << text(moments) << "\"/>";
    add_shape(of, "0 0 0");
    add_what_hangs_on(i);
    out_ << "</body>";
  }

  void add_joint(const Joint& joint, int child, int parent) {
    if (!joint.length) {
      out_ << "<joint type=\"ball\" pos=\"" << text(joint.j == child ? joint.p_j : joint.p_i) << "\"/>";
      return;
    }
    const Vec3 rod = body(child).q.conjugate() * (body(parent).x - body(child).x);
    const Vec3 side = rod.unitOrthogonal();
    for (const Vec3& axis : {side, Vec3(rod.normalized().cross(side))})
      out_ << "<joint type=\"hinge\" pos=\"" << text(rod) << "\" axis=\"" << text(axis) << "\"/>";
  }

  void add_what_hangs_on(int i) {
    for (const Joint& joint : problem_.joints) {
      if (joint.i != i && joint.j != i) continue;
      const int child = joint.i == i ? joint.j : joint.i;
      if (!body(child).moves || written_[static_cast<std::size_t>(child)]) continue;
      in_tree_.push_back(&joint);
      add_body(child, &joint, i);
    }
  }

  /// Returns the joints that are in no tree, as constraints.
  std::string loops() const {
    std::ostringstream found;
    for (const Joint& joint : problem_.joints) {
      if (std::find(in_tree_.begin(), in_tree_.end(), &joint) != in_tree_.end()) continue;
      if (joint.length) throw std::runtime_error("this adapter has no loops of rods");
      const bool i_moves = body(joint.i).moves;
      const int first = i_moves ? joint.i : joint.j, second = i_moves ? joint.j : joint.i;
      found << "<connect body1=\"b" << first << "\" anchor=\"" << text(i_moves ? joint.p_i : joint.p_j) << '"';
      if (body(second).moves) found << " body2=\"b" << second << '"';
      found << "/>";
    }
    return found.str();
  }

  const Problem& problem_;
  std::vector<bool> written_;
  std::vector<const Joint*> in_tree_;
  std::ostringstream out_;
};

mjModel* model_of(const Problem& problem, const Way& way) {
  std::string name = "/tmp/spook_mujoco_XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0) throw std::runtime_error("no temporary file could be made for a model of MuJoCo");
  close(file);
  std::ofstream(name) << ModelText(problem, way).all();
  char error[1000] = "";
  mjModel* const model = mj_loadXML(name.c_str(), nullptr, error, sizeof error);
  std::remove(name.c_str());
  if (!model) throw std::runtime_error("MuJoCo refuses the model: " + std::string(error));
  return model;
}

class Mujoco : public Engine {
 public:
  Mujoco(const Problem& problem, const Way& way)
      : problem_(problem), model_(model_of(problem, way)), data_(mj_makeData(model_)) {
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
      std::string name = "b";
      name += std::to_string(i);
      bodies_.push_back(problem.bodies[i].moves ? mj_name2id(model_, mjOBJ_BODY, name.c_str()) : 0);
    }
    mj_kinematics(model_, data_);
    mj_comPos(model_, data_);
    set_velocities();
  }
  ~Mujoco() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  void advance(std::int64_t steps) override {
    for (std::int64_t n = 0; n < steps; ++n) {
      mj_step(model_, data_);
      for (const mjtWarning of :
           {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_CONTACTFULL, mjWARN_CNSTRFULL})
        if (data_->warning[of].number > 0) throw Lost();
    }
    mj_kinematics(model_, data_);  // a step ends with velocities and coordinates
  }
  Vec3 x(int body) const override {
    const ProblemBody& of = problem_.bodies[static_cast<std::size_t>(body)];
    return of.moves ? Vec3(Eigen::Map<const Vec3>(data_->xpos + 3 * id(body))) : of.x;
  }
  Quat q(int body) const override {
    if (!problem_.bodies[static_cast<std::size_t>(body)].moves) return Quat::Identity();
    const mjtNum* q = data_->xquat + 4 * id(body);
    return Quat(q[0], q[1], q[2], q[3]);
  }

 private:
  int id(int body) const { return bodies_[static_cast<std::size_t>(body)]; }

  /// Sets velocities of the coordinates such that bodies have their initial velocities, as nearly as joints allow.
  void set_velocities() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const ProblemBody& body = problem_.bodies[i];
      const int joint = model_->body_jntadr[bodies_[i]];
      if (!body.moves || model_->jnt_type[joint] != mjJNT_FREE) continue;
      mjtNum* const v = data_->qvel + model_->jnt_dofadr[joint];
      Eigen::Map<Vec3>{v} = body.v;
      Eigen::Map<Vec3>{v + 3} = body.q.conjugate() * body.omega;
    }
    if (!problem_.joints.empty()) set_velocities_of_trees();
  }
  void set_velocities_of_trees() {
    Matrix J(0, model_->nv);
    Eigen::VectorXd wanted(0);
    bool moves = false;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const ProblemBody& body = problem_.bodies[i];
      if (!body.moves) continue;
      moves = moves || !body.v.isZero(0) || !body.omega.isZero(0);
      const Eigen::Index row = J.rows();
      Matrix linear(3, model_->nv);
      mj_jacBody(model_, data_, linear.data(), nullptr, bodies_[i]);
      J.conservativeResize(row + 3, Eigen::NoChange);
      J.bottomRows(3) = linear;
      wanted.conservativeResize(row + 3);
      wanted.tail<3>() = body.v;
    }
    if (moves) Eigen::Map<Eigen::VectorXd>(data_->qvel, model_->nv) = J.colPivHouseholderQr().solve(wanted);
  }

  Problem problem_;
  mjModel* model_;
  mjData* data_;
  std::vector<int> bodies_;  // MuJoCo's index of each body; 0, the world, of static ones
};

}  // namespace

std::unique_ptr<Engine> make_mujoco(const Problem& problem, const Way& way) {
  mju_user_warning = [](const char*) {};  // the consequences are visible in the error
  mju_user_error = [](const char*) { throw Lost(); };
  return std::make_unique<Mujoco>(problem, way);
}

}  // namespace spook::peers
