"""The papers behind the numbers. Objects name keys in ``citation_keys``; ``cite`` turns them into text."""

from __future__ import annotations

from .errors import InputError

REFERENCES = {
    "Abbott1933": "Abbott, E. J., Firestone, F. A. (1933). Specifying surface quality: a method based on accurate measurement and comparison. Mechanical Engineering 55, 569-572.",
    "Almqvist2007": "Almqvist, A., Sahlin, F., Larsson, R., Glavatskih, S. (2007). On the dry elasto-plastic contact of nominally flat surfaces. Tribology International 40, 574-579.",
    "Bemporad2015": "Bemporad, A., Paggi, M. (2015). Optimization algorithms for the solution of the frictionless normal contact between rough surfaces. International Journal of Solids and Structures 69-70, 94-105.",
    "Bertsekas1976": "Bertsekas, D. P. (1976). On the Goldstein-Levitin-Polyak gradient projection method. IEEE Transactions on Automatic Control 21, 174-184.",
    "Bhushan1998": "Bhushan, B. (1998). Contact mechanics of rough surfaces in tribology: multiple asperity contact. Tribology Letters 4, 1-35.",
    "Boussinesq1885": "Boussinesq, J. (1885). Application des potentiels a l'etude de l'equilibre et du mouvement des solides elastiques. Gauthier-Villars, Paris.",
    "Burmister1945": "Burmister, D. M. (1945). The general theory of stresses and displacements in layered systems. I. Journal of Applied Physics 16, 89-94.",
    "Byrd1995": "Byrd, R. H., Lu, P., Nocedal, J., Zhu, C. (1995). A limited memory algorithm for bound constrained optimization. SIAM Journal on Scientific Computing 16, 1190-1208.",
    "Cole1992": "Cole, S. J., Sayles, R. S. (1992). A numerical model for the contact of layered elastic bodies with real rough surfaces. Journal of Tribology 114, 334-340.",
    "Cottle1992": "Cottle, R. W., Pang, J.-S., Stone, R. E. (1992). The Linear Complementarity Problem. Academic Press, Boston.",
    "Dietrich1997": "Dietrich, C. R., Newsam, G. N. (1997). Fast and exact simulation of stationary Gaussian processes through circulant embedding of the covariance matrix. SIAM Journal on Scientific Computing 18, 1088-1107.",
    "Ganti1995": "Ganti, S., Bhushan, B. (1995). Generalized fractal analysis and its applications to engineering surfaces. Wear 180, 17-34.",
    "Greenwood1966": "Greenwood, J. A., Williamson, J. B. P. (1966). Contact of nominally flat surfaces. Proceedings of the Royal Society A 295, 300-319.",
    "Hamilton2000": "Hamilton, A. J. S. (2000). Uncorrelated modes of the non-linear power spectrum. Monthly Notices of the Royal Astronomical Society 312, 257-284.",
    "ISO25178": "ISO 25178-2:2021. Geometrical product specifications (GPS) - Surface texture: Areal - Part 2: Terms, definitions and surface texture parameters.",
    "Jacobs2017": "Jacobs, T. D. B., Junge, T., Pastewka, L. (2017). Quantitative characterization of surface topography using spectral analysis. Surface Topography: Metrology and Properties 5, 013001.",
    "Johnson1985": "Johnson, K. L. (1985). Contact Mechanics. Cambridge University Press.",
    "Kalker1977": "Kalker, J. J. (1977). Variational principles of contact elastostatics. IMA Journal of Applied Mathematics 20, 199-219.",
    "Lawson1974": "Lawson, C. L., Hanson, R. J. (1974). Solving Least Squares Problems. Prentice-Hall, Englewood Cliffs.",
    "Liu2000": "Liu, S., Wang, Q., Liu, G. (2000). A versatile method of discrete convolution and FFT (DC-FFT) for contact analyses. Wear 243, 101-111.",
    "LonguetHiggins1957": "Longuet-Higgins, M. S. (1957). The statistical analysis of a random, moving surface. Philosophical Transactions of the Royal Society A 249, 321-387.",
    "Love1929": "Love, A. E. H. (1929). The stress produced in a semi-infinite solid by pressure on part of the boundary. Philosophical Transactions of the Royal Society A 228, 377-420.",
    "Majumdar1990": "Majumdar, A., Bhushan, B. (1990). Role of fractal geometry in roughness characterization and contact mechanics of surfaces. Journal of Tribology 112, 205-216.",
    "McCool1986": "McCool, J. I. (1986). Comparison of models for the contact of rough surfaces. Wear 107, 37-60.",
    "McCool1987": "McCool, J. I. (1987). Relating profile instrument measurements to the functional performance of rough surfaces. Journal of Tribology 109, 264-270.",
    "Moisan2011": "Moisan, L. (2011). Periodic plus smooth image decomposition. Journal of Mathematical Imaging and Vision 39, 161-179.",
    "Nayak1971": "Nayak, P. R. (1971). Random process model of rough surfaces. Journal of Lubrication Technology 93, 398-407.",
    "Nogi1997": "Nogi, T., Kato, T. (1997). Influence of a hard surface layer on the limit of elastic contact, part I. Journal of Tribology 119, 493-500.",
    "OSullivan1988": "O'Sullivan, T. C., King, R. B. (1988). Sliding contact stress field due to a spherical indenter on a layered elastic half-space. Journal of Tribology 110, 235-240.",
    "Peng2001": "Peng, W. (2001). Contact mechanics of multilayered rough surfaces in tribology. Dissertation, Ohio State University.",
    "PengBhushan2001": "Peng, W., Bhushan, B. (2001). A numerical three-dimensional model for the contact of layered elastic/plastic solids with rough surfaces by a variational principle. Journal of Tribology 123, 330-342.",
    "Polonsky1999": "Polonsky, I. A., Keer, L. M. (1999). A numerical method for solving rough contact problems based on the multi-level multi-summation and conjugate gradient techniques. Wear 231, 206-219.",
    "Poon1995": "Poon, C. Y., Bhushan, B. (1995). Comparison of surface roughness measurements by stylus profiler, AFM and non-contact optical profiler. Wear 190, 76-88.",
    "Roettger2022": "Roettger, M. C., Sanner, A., Thimons, L. A., et al. (2022). contact.engineering - Create, analyze and publish digital surface twins from topography measurements across many scales. Surface Topography: Metrology and Properties 10, 035032.",
    "Sanner2022": "Sanner, A., Nohring, W. G., Thimons, L. A., Jacobs, T. D. B., Pastewka, L. (2022). Scale-dependent roughness parameters for topography analysis. Applied Surface Science Advances 7, 100190.",
    "Stanley1997": "Stanley, H. M., Kato, T. (1997). An FFT-based method for rough surface contact. Journal of Tribology 119, 481-485.",
    "Tan2006": "Tan, E. L. (2006). Hybrid compliance-stiffness matrix method for stable analysis of elastic wave propagation in multilayered anisotropic media. Journal of the Acoustical Society of America 119, 45-53.",
    "Tian1996": "Tian, X., Bhushan, B. (1996). A numerical three-dimensional model for the contact of rough surfaces by variational principle. Journal of Tribology 118, 33-42.",
    "Whitehouse1970": "Whitehouse, D. J., Archard, J. F. (1970). The properties of random surfaces of significance in their contact. Proceedings of the Royal Society A 316, 97-121.",
    "Whitehouse1978": "Whitehouse, D. J., Phillips, M. J. (1978). Discrete properties of random surfaces. Philosophical Transactions of the Royal Society A 290, 267-298.",
    "Whittle1953": "Whittle, P. (1953). Estimation and information in stationary time series. Arkiv for Matematik 2, 423-434.",
    "Yastrebov2017": "Yastrebov, V. A., Anciaux, G., Molinari, J.-F. (2017). On the accurate computation of the true contact-area in mechanical contact of random rough surfaces. Tribology International 114, 161-171.",
}
"""Full references by key."""


def citation_keys(*objects: object) -> tuple[str, ...]:
    """Sorted, distinct keys that the ``objects`` name in their attribute ``citation_keys``."""
    return tuple(sorted({key for item in objects for key in getattr(item, "citation_keys", ())}))


def reference(key: str) -> str:
    """Full reference of ``key``.

    Raises
    ------
    InputError
        If the key is unknown.
    """
    if key not in REFERENCES:
        raise InputError(f"citation key must be one of {', '.join(sorted(REFERENCES))}, but is {key!r}.")
    return REFERENCES[key]


def cite(*objects: object) -> str:
    """Text with one full reference a line for everything the ``objects`` (surface, problem, result, …) rest on.

    Raises
    ------
    InputError
        If an object names a paper that is not in the list.
    """
    return "\n".join(f"[{key}] {reference(key)}" for key in citation_keys(*objects))
