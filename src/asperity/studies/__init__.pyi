from ..cli.press import press
from ..physics.prediction.predict import predict
from ..physics.prediction.prediction import Prediction
from ..run.execute import Outcome
from ..run.run import run
from ..theories.rough.predictor import Expected
from .calibrate import calibrate
from .calibration import Calibration
from .campaign import Campaign, open_study, run_study
from .collect import CampaignState
from .compare import compare
from .comparison import Comparison
from .design.answer import Design
from .design.optimise import optimise

__all__ = [
    "Calibration",
    "Campaign",
    "CampaignState",
    "Comparison",
    "Design",
    "Expected",
    "Outcome",
    "Prediction",
    "calibrate",
    "compare",
    "open_study",
    "optimise",
    "predict",
    "press",
    "run",
    "run_study",
]
