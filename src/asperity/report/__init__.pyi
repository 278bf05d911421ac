from .animation import save_plastic_animation
from .animation_wear import save_wear_animation
from .comparison import write_comparison_report
from .profile import write_profile_report
from .roughness import write_roughness_report
from .scans import write_scans_report
from .write import write_report

__all__ = [
    "save_plastic_animation",
    "save_wear_animation",
    "write_comparison_report",
    "write_profile_report",
    "write_report",
    "write_roughness_report",
    "write_scans_report",
]
