from ..cli.press import press
from ..run.execute import Outcome
from ..run.run import run
from .campaign import Campaign, open_study, run_study
from .collect import CampaignState
from .compare import compare
from .comparison import Comparison

__all__ = ["Campaign", "CampaignState", "Comparison", "Outcome", "compare", "open_study", "press", "run", "run_study"]
