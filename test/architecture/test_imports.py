"""Who may import whom: the table of the house, read from the sources, imports inside functions included."""

import ast
import sys
from graphlib import TopologicalSorter

from source_tree import CHECKOUT, modules, shown, tree

MESSAGES = (
    "builtin_interfaces diagnostic_msgs geometry_msgs nav_msgs pdr_msgs rcl_interfaces sensor_msgs std_msgs tf2_msgs"
)
BASE = (
    "numpy pdr_core.records pdr_core.records_gait pdr_core.records_power pdr_core.records_external"
    " pdr_core.conventions pdr_core.parameter"
    " pdr_core.params pdr_core.notices pdr_core.field_pairing pdr_core.rate_limit"
)
STAGE = f"{BASE} pdr_core.maths scipy"
# in the order in which a sample meets them; a stage that does not exist yet has its row already
STAGES = (
    "intake",
    "stance",
    "strapdown",
    "eskf",
    "attitude",
    "heading",
    "gait",
    "power",
    "fusion",
    "chest",
    "external",
)
ALL_STAGES = " ".join(f"pdr_core.{stage}" for stage in STAGES)
PARTS_OF_NODES = {m.split(".")[1] for m in modules() if m.startswith("pdr_nodes.")} - {"devices"}
HELPERS = " ".join(f"pdr_nodes.{part}" for part in sorted(PARTS_OF_NODES) if not part.endswith("_node"))
# `warmup` compiles all stages, so that a node that is started alone finds the cache that the others use
NODE = f"{BASE} {MESSAGES} rclpy {HELPERS} pdr_core.warmup"
READS = "pdr_nodes.convert pdr_nodes.notice_board pdr_nodes.qos"
RESULTS = "pdr_core.warmup pdr_core.pipeline pdr_core.evaluation pdr_core.recording pdr_core.simulation pdr_core.bench"

# module or package -> what it and all below it may import beside the standard library and itself; the longest name wins
MAY_IMPORT = {
    "pdr_core": "",
    "pdr_core.records": "numpy pdr_core.conventions",
    "pdr_core.records_gait": "numpy pdr_core.records",
    "pdr_core.records_power": "pdr_core.records_gait",
    "pdr_core.records_external": "numpy pdr_core.records",
    "pdr_core.conventions": "numpy",
    "pdr_core.parameter": "",
    "pdr_core.params_foot": "pdr_core.parameter",
    "pdr_core.params_detectors": "pdr_core.parameter",
    "pdr_core.params_attitude": "pdr_core.parameter",
    "pdr_core.params_power": "pdr_core.parameter",
    "pdr_core.params_gait": "pdr_core.parameter",
    "pdr_core.params_heading": "pdr_core.parameter",
    "pdr_core.params_fusion": "pdr_core.parameter",
    "pdr_core.params_external": "pdr_core.parameter",
    "pdr_core.params_simulation": "pdr_core.parameter",
    "pdr_core.params_dead_reckoning": "pdr_core.parameter",
    "pdr_core.params_chest": "pdr_core.parameter",
    "pdr_core.params": (
        "pdr_core.parameter pdr_core.params_foot pdr_core.params_detectors pdr_core.params_attitude"
        " pdr_core.params_heading pdr_core.params_simulation pdr_core.params_gait pdr_core.params_dead_reckoning"
        " pdr_core.params_power pdr_core.params_fusion pdr_core.params_chest"
        " pdr_core.params_external"
    ),
    "pdr_core.notices": "pdr_core.records",
    "pdr_core.field_pairing": "numpy pdr_core.records pdr_core.records_gait pdr_core.conventions pdr_core.notices",
    "pdr_core.rate_limit": "pdr_core.records pdr_core.conventions",
    "pdr_core.params_file": "yaml pdr_core.parameter pdr_core.params",
    "pdr_core.maths": f"{BASE} scipy",
    "pdr_core.maths.compiled": "numba",  # the only one: here the cache is keyed on the sources
    **{f"pdr_core.{stage}": STAGE for stage in STAGES},
    # the filter predicts by mechanisation: one compiled loop per sample, so the two cannot meet in the pipeline
    "pdr_core.eskf": f"{STAGE} pdr_core.strapdown",
    "pdr_core.chest": f"{STAGE} pdr_core.strapdown",  # for the same reason
    "pdr_core.attitude": f"{STAGE} pdr_core.strapdown",  # for the same reason: what two samples say of their interval
    "pdr_core.pipeline": f"{STAGE} {ALL_STAGES}",
    "pdr_core.warmup": f"{BASE} pdr_core.pipeline pdr_core.simulation",
    "pdr_core.recording": f"{STAGE} rosbags mcap yaml apsw lz4 zstandard",
    "pdr_core.simulation": STAGE,
    "pdr_core.evaluation": f"{STAGE} plotly jinja2",
    "pdr_core.bench": f"{STAGE} {ALL_STAGES} pdr_core.pipeline pdr_core.simulation pdr_core.evaluation",
    "pdr_core.bench.orientations": f"{STAGE} {ALL_STAGES} ahrs",  # the library that ours are compared with
    "pdr_nodes": f"{BASE} {MESSAGES} rclpy {HELPERS}",  # the helpers: neither a stage nor a device
    "pdr_nodes.qos": "rclpy",
    # `run` turns what a user can mend into one sentence, and a recording that cannot be opened is such a thing
    "pdr_nodes.run": f"{BASE} rclpy pdr_nodes.managed pdr_core.recording",
    "pdr_nodes.devices": f"{BASE} pdr_core.maths.motion_switch pdr_core.recording pdr_core.simulation serial",
    "pdr_nodes.imu_driver_node": f"{NODE} pdr_nodes.devices pdr_core.power.motion_rule",
    "pdr_nodes.imu_ingestion_node": f"{NODE} pdr_core.pipeline",  # intake and orientation meet there
    "pdr_nodes.heading_fusion_node": f"{NODE} pdr_core.pipeline",  # heading constraint and fusion meet there
    # in aid mode it is `heading_fusion` and more
    "pdr_nodes.external_odometry_node": f"{NODE} pdr_core.pipeline pdr_core.external pdr_nodes.heading_fusion_node",
    "pdr_nodes.stance_detector_node": f"{NODE} pdr_core.stance",
    "pdr_nodes.zupt_ekf_node": f"{NODE} pdr_core.eskf",
    "pdr_nodes.chest_pdr_node": f"{NODE} pdr_core.pipeline",  # chest, step length and heading meet there
    "pdr_nodes.gait_dr_node": f"{NODE} pdr_core.pipeline",  # the filter and dead reckoning meet there
    "pdr_nodes.mode_manager_node": f"{NODE} pdr_core.power",
    # commands see stages through the pipeline only, and of the nodes what reads their messages
    "pdr_bringup_scripts": f"{BASE} pdr_core.__version__ {RESULTS} pdr_core.params_file typer rich yaml {READS}",
    "pdr_bringup_scripts.live.listener": f"{BASE} {READS} rclpy ament_index_python pdr_core.recording.bag_writer",
    # watch the nodes as anybody on the graph can
    "pdr_bringup_scripts.live.graph": "rclpy pdr_nodes.__path__ pdr_bringup_scripts.live.cast",
    "pdr_bringup_scripts.launching": "launch launch_ros",
    "pdr_bringup_scripts.live.node_parameters": f"{BASE} rclpy",
    "pdr_bringup_scripts.live.recorder": "rclpy pdr_bringup_scripts pdr_core.params_file"
    " pdr_core.recording.mcap_writer",
    "pdr_bringup_scripts.live.relay": f"{READS} rclpy sensor_msgs pdr_bringup_scripts.live.cast",
    # reads back our own messages, which are no recording of samples; the door to those is `open_recording`
    "pdr_bringup_scripts.live.live_recording": f"{BASE} {READS} rosbags pdr_core.pipeline pdr_bringup_scripts.problems"
    " pdr_bringup_scripts.live.cast",
    "pdr_bringup_scripts.live.switched_recording": f"{BASE} {READS} pdr_nodes.convert_mode pdr_core.pipeline"
    " pdr_core.evaluation pdr_bringup_scripts.problems pdr_bringup_scripts.live.cast"
    " pdr_bringup_scripts.live.live_recording",
}
ROOTS = ("pdr_core", "pdr_nodes")  # a row for what has none of its own; not a layer whose modules see each other
IMPURE = {"time", "datetime", "logging", "warnings", "sys", "subprocess", "threading"}


def imports(path):
    """Every (line, name) that a file imports; a name is `module` or `module.attribute`."""
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            start = "relative." * node.level + (node.module or "")
            yield from ((node.lineno, f"{start}.{alias.name}") for alias in node.names)


def row(module):
    """The longest name in the table that `module` lies below."""
    parts = module.split(".")
    names = [".".join(parts[:n]) for n in range(len(parts), 0, -1)]
    return next(name for name in names if name in MAY_IMPORT)


def top(name):
    return name.split(".")[0]


def below(name, parent):
    return name == parent or name.startswith(parent + ".")


def allowed(module, name):
    here = row(module)
    own = [here] if here not in ROOTS else []
    return top(name) in sys.stdlib_module_names or any(below(name, parent) for parent in own + MAY_IMPORT[here].split())


def test_every_import_is_in_the_table():
    wrong = [
        f"{shown(path)}:{line} imports {name}"
        for module, path in modules().items()
        for line, name in imports(path)
        if not allowed(module, name)
    ]
    assert wrong == []


def module_of(name):
    """The module of ours that an imported name is, or lies in; None of others."""
    return next((known for known in (name, name.rpartition(".")[0]) if known in modules()), None)


def test_no_modules_import_one_another():
    needs = {module: {module_of(name) for _, name in imports(path)} for module, path in modules().items()}
    TopologicalSorter({module: found - {None, module} for module, found in needs.items()}).prepare()


def test_every_layer_and_node_has_its_own_row():
    homes = {module: row(module) for module in modules() if module.count(".") == 1}
    homeless = {m for m, home in homes.items() if home == "pdr_core" or (home == "pdr_nodes" and m.endswith("_node"))}
    assert homeless == set()


def test_nobody_imports_the_commands():
    wrong = [
        f"{shown(path)}:{line}"
        for module, path in modules().items()
        for line, name in imports(path)
        if below(name, "pdr_bringup_scripts") and not below(module, "pdr_bringup_scripts")
    ]
    assert wrong == []


def test_the_core_knows_no_ros_clock_log_or_terminal():
    banned = IMPURE | {"rclpy", "pdr_nodes", "ament_index_python", *MESSAGES.split()}
    core = {module: path for module, path in modules().items() if below(module, "pdr_core")}
    wrong = [
        f"{shown(path)}:{line} {name}" for path in core.values() for line, name in imports(path) if top(name) in banned
    ]
    for path in core.values():
        calls = [node for node in ast.walk(tree(path)) if isinstance(node, ast.Call)]
        wrong += [f"{shown(path)}:{call.lineno} prints" for call in calls if ast.unparse(call.func) == "print"]
    assert wrong == []


def test_the_set_up_needs_nothing_but_python():
    files = sorted((CHECKOUT / "pdr_bringup_scripts" / "bootstrap").glob("*.py"))
    known = sys.stdlib_module_names | {"bootstrap"}
    wrong = [f"{shown(path)}:{line} {name}" for path in files for line, name in imports(path) if top(name) not in known]
    assert files
    assert wrong == []
