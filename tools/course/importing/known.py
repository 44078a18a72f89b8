"""Lists the elements and attributes of MJCF that the import knows. All else in a model is left out, and named."""

from xml.etree.ElementTree import Element

from importing.report import Report, attributes

_TURN = "quat axisangle euler xyaxes zaxis"
_NEVER = "user group name class"  # nothing moves differently for them

# Read: what becomes part of the scene, or is named where it is read.
_READ = {
    "mujoco": "model",
    "compiler": "angle eulerseq inertiafromgeom autolimits coordinate settotalmass boundmass boundinertia",
    "option": "timestep gravity",
    "flag": "gravity contact constraint limit equality passive damper spring filterparent",
    "body": f"pos {_TURN} childclass mocap gravcomp",
    "frame": f"pos {_TURN} childclass",
    "inertial": f"pos {_TURN} mass diaginertia fullinertia",
    "joint": "type pos axis range limited damping ref stiffness springref frictionloss armature",
    "freejoint": "",
    "geom": f"type size pos {_TURN} fromto mass density friction contype conaffinity condim "
            "priority",
    "connect": "body1 body2 anchor active",
    "weld": "body1 body2 anchor relpose active",
    "exclude": "body1 body2",
    "replicate": "count offset euler sep",
    "include": "file",
    "default": "", "worldbody": "", "equality": "", "contact": "",
}

# Without a part in how a model without drives moves, or a matter of MuJoCo's own solver.
_NO_MATTER = {
    "compiler": "meshdir texturedir assetdir strippath discardvisual fusestatic usethread convexhull alignfree "
                "saveinertial",
    "option": "integrator cone jacobian solver iterations tolerance ls_iterations ls_tolerance noslip_iterations "
              "noslip_tolerance mpr_iterations mpr_tolerance ccd_iterations ccd_tolerance sdf_iterations "
              "sdf_initpoints apirate impratio actuatorgroupdisable sleep_tolerance",
    "flag": "warmstart refsafe clampctrl sensor midphase nativeccd island multiccd energy fwdinv invdiscrete autoreset "
            "actuation eulerdamp frictionloss sleep",
    "body": "sleep",
    "freejoint": "align",
    "joint": "actuatorfrcrange actuatorfrclimited actuatorgravcomp",
    "geom": "material rgba hfield mesh fitscale",
}
_SKIPPED = {"asset", "visual", "statistic", "size", "custom", "sensor", "site", "camera", "light"}  # with all inside
# Named in another place, by their number.
_COUNTED = {"actuator", "tendon", "keyframe", "deformable", "extension", "pair", "composite", "flexcomp", "attach"}
# Attributes that change nothing while they have these values.
_NEUTRAL = {("option", "density"): 0.0, ("option", "viscosity"): 0.0, ("option", "wind"): 0.0,
            ("geom", "margin"): 0.0, ("geom", "gap"): 0.0, ("joint", "margin"): 0.0}
_NEUTRAL_TEXT = {("geom", "fluidshape"): "none", ("geom", "shellinertia"): "false", ("flag", "override"): "disable",
                 ("option", "collision"): "all", ("compiler", "balanceinertia"): "false"}


def name_unknown(element: Element, report: Report, above: str = "") -> None:
    """Names each element and attribute that is neither read nor without a part in the motion."""
    tag = element.tag
    if tag in _SKIPPED or tag in _COUNTED or above == "equality" and tag not in ("connect", "weld"):
        return
    if tag not in _READ:
        report.leave_out(f"element {tag}, which the import does not know", element)
        return
    known = f"{_READ[tag]} {_NO_MATTER.get(tag, '')} {_NEVER}".split()
    for name, value in attributes(element).items():
        if name not in known and not _is_neutral(tag, name, value):
            report.leave_out(f"{name} of {_kind(tag)}", element)
    for child in element:
        name_unknown(child, report, tag)


def _is_neutral(tag: str, name: str, value: str) -> bool:
    if (tag, name) in _NEUTRAL_TEXT:
        return value == _NEUTRAL_TEXT[tag, name]
    try:
        return (tag, name) in _NEUTRAL and all(float(word) == _NEUTRAL[tag, name] for word in value.split())
    except ValueError:
        return False


def _kind(tag: str) -> str:
    """Returns the kind of an element: `option density`, but `density` of bodies."""
    kinds = {"body": "bodies", "mujoco": "the model", "option": "the option", "compiler": "the compiler",
             "flag": "the option's flags", "inertial": "inertials"}
    return kinds.get(tag, f"{tag}s")
