"""The papers behind the numbers. Objects name keys in ``citation_keys``; ``cite`` turns them into
text."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from .errors import InputError
from .status import Advice

REFERENCES = {
    "Abbott1933": "Abbott, E. J., Firestone, F. A. (1933). Specifying surface quality: a method based on accurate measurement and comparison. Mechanical Engineering 55, 569-572.",
    "Afferrante2012": "Afferrante, L., Carbone, G., Demelio, G. (2012). Interacting and coalescing Hertzian asperities: a new multiasperity contact model. Wear 278-279, 28-33.",
    "Akarapu2011": "Akarapu, S., Sharp, T., Robbins, M. O. (2011). Stiffness of contacts between rough surfaces. Physical Review Letters 106, 204301.",
    "Alart1991": "Alart, P., Curnier, A. (1991). A mixed formulation for frictional contact problems prone to Newton like solution methods. Computer Methods in Applied Mechanics and Engineering 92, 353-375.",
    "Almqvist2007": "Almqvist, A., Sahlin, F., Larsson, R., Glavatskih, S. (2007). On the dry elasto-plastic contact of nominally flat surfaces. Tribology International 40, 574-579.",
    "Anderson1965": "Anderson, D. G. (1965). Iterative procedures for nonlinear integral equations. Journal of the ACM 12, 547-560.",
    "Archard1953": "Archard, J. F. (1953). Contact and rubbing of flat surfaces. Journal of Applied Physics 24, 981-988.",
    "Arnaud2021": "Arnaud, P., Baydoun, S., Fouvry, S. (2021). Modeling adhesive and abrasive wear phenomena in fretting interfaces: a multiphysics approach coupling friction energy, third body and contact oxygenation concepts. Tribology International 161, 107077.",
    "AstmG99": "ASTM International (2017). Standard test method for wear testing with a pin-on-disk apparatus, G99-17. West Conshohocken.",
    "Ausloos1985": "Ausloos, M., Berman, D. H. (1985). A multivariate Weierstrass-Mandelbrot function. Proceedings of the Royal Society A 400, 331-350.",
    "Barber2003": "Barber, J. R. (2003). Bounds on the electrical resistance between contacting elastic rough bodies. Proceedings of the Royal Society A 459, 53-66.",
    "Barthel2007": "Barthel, E., Perriot, A. (2007). Adhesive contact to a coated elastic substrate. Journal of Physics D: Applied Physics 40, 1059-1067.",
    "Baydoun2019": "Baydoun, S., Fouvry, S., Descartes, S., Arnaud, P. (2019). Fretting wear rate evolution of a flat-on-flat low alloyed steel contact: a weighted friction energy formulation. Wear 426-427, 676-693.",
    "Beck2009": "Beck, A., Teboulle, M. (2009). A fast iterative shrinkage-thresholding algorithm for linear inverse problems. SIAM Journal on Imaging Sciences 2, 183-202.",
    "Bemporad2015": "Bemporad, A., Paggi, M. (2015). Optimization algorithms for the solution of the frictionless normal contact between rough surfaces. International Journal of Solids and Structures 69-70, 94-105.",
    "Bertsekas1976": "Bertsekas, D. P. (1976). On the Goldstein-Levitin-Polyak gradient projection method. IEEE Transactions on Automatic Control 21, 174-184.",
    "Bhattacharya1988": "Bhattacharya, A. K., Nix, W. D. (1988). Analysis of elastic and plastic deformation associated with indentation testing of thin films on substrates. International Journal of Solids and Structures 24, 1287-1298.",
    "Bhushan1984": "Bhushan, B. (1984). Analysis of the real area of contact between a polymeric magnetic medium and a rigid surface. Journal of Tribology 106, 26-34.",
    "Bhushan1998": "Bhushan, B. (1998). Contact mechanics of rough surfaces in tribology: multiple asperity contact. Tribology Letters 4, 1-35.",
    "BhushanKotwal1998": "Bhushan, B., Kotwal, C. A., Chilamakuri, S. K. (1998). Kinetic meniscus model for prediction of rest stiction. Journal of Tribology 120, 42-50.",
    "BhushanMajumdar1992": "Bhushan, B., Majumdar, A. (1992). Elastic-plastic contact model for bifractal surfaces. Wear 153, 53-64.",
    "Birgin2000": "Birgin, E. G., Martínez, J. M., Raydan, M. (2000). Nonmonotone spectral projected gradient methods on convex sets. SIAM Journal on Optimization 10, 1196-1211.",
    "Blok1937": "Blok, H. (1937). Theoretical study of temperature rise at surfaces of actual contact under oiliness lubricating conditions. Proceedings of the Institution of Mechanical Engineers, General Discussion on Lubrication 2, 222-235.",
    "Boussinesq1885": "Boussinesq, J. (1885). Application des potentiels a l'etude de l'equilibre et du mouvement des solides elastiques. Gauthier-Villars, Paris.",
    "Bruggeman1935": "Bruggeman, D. A. G. (1935). Berechnung verschiedener physikalischer Konstanten von heterogenen Substanzen. Annalen der Physik 416, 636-664.",
    "Burgdorfer1959": "Burgdorfer, A. (1959). The influence of the molecular mean free path on the performance of hydrodynamic gas lubricated bearings. Journal of Basic Engineering 81, 94-98.",
    "Burmister1945": "Burmister, D. M. (1945). The general theory of stresses and displacements in layered systems. I. Journal of Applied Physics 16, 89-94.",
    "Burton1980": "Burton, R. A. (1980). Thermal deformation in frictionally heated contact. Wear 59, 1-20.",
    "Bush1975": "Bush, A. W., Gibson, R. D., Thomas, T. R. (1975). The elastic contact of a rough surface. Wear 35, 87-111.",
    "Bush1979": "Bush, A. W., Gibson, R. D., Keogh, G. P. (1979). Strongly anisotropic rough surfaces. Journal of Lubrication Technology 101, 15-20.",
    "Byrd1995": "Byrd, R. H., Lu, P., Nocedal, J., Zhu, C. (1995). A limited memory algorithm for bound constrained optimization. SIAM Journal on Scientific Computing 16, 1190-1208.",
    "Carbone2008": "Carbone, G., Bottiglione, F. (2008). Asperity contact theories: do they predict linearity between contact area and load? Journal of the Mechanics and Physics of Solids 56, 2555-2572.",
    "Carbone2013": "Carbone, G., Putignano, C. (2013). A novel methodology to predict sliding and rolling friction of viscoelastic materials: theory and experiments. Journal of the Mechanics and Physics of Solids 61, 1822-1834.",
    "CarslawJaeger1959": "Carslaw, H. S., Jaeger, J. C. (1959). Conduction of Heat in Solids, 2nd ed. Oxford University Press.",
    "Carter1926": "Carter, F. W. (1926). On the action of a locomotive driving wheel. Proceedings of the Royal Society A 112, 151-157.",
    "Cattaneo1938": "Cattaneo, C. (1938). Sul contatto di due corpi elastici: distribuzione locale degli sforzi. Rendiconti dell'Accademia Nazionale dei Lincei 27, 342-348, 434-436, 474-478.",
    "Cerruti1882": "Cerruti, V. (1882). Ricerche intorno all'equilibrio dei corpi elastici isotropi. Atti della Reale Accademia dei Lincei, Memorie della Classe di Scienze Fisiche, Matematiche e Naturali 13, 81-122.",
    "Chang1987": "Chang, W. R., Etsion, I., Bogy, D. B. (1987). An elastic-plastic model for the contact of rough surfaces. Journal of Tribology 109, 257-263.",
    "Chilamakuri1998": "Chilamakuri, S. K., Bhushan, B. (1998). Contact analysis of non-Gaussian random surfaces. Proceedings of the Institution of Mechanical Engineers J 212, 19-32.",
    "Ciavarella1998": "Ciavarella, M. (1998). The generalized Cattaneo partial slip plane contact problem. International Journal of Solids and Structures 35, 2349-2378.",
    "Ciavarella2001": "Ciavarella, M., Decuzzi, P. (2001). The state of stress induced by the plane frictionless cylindrical contact. I. The case of elastic similarity. International Journal of Solids and Structures 38, 4507-4523.",
    "Ciavarella2008": "Ciavarella, M., Greenwood, J. A., Paggi, M. (2008). Inclusion of interaction in the Greenwood and Williamson contact theory. Wear 265, 729-734.",
    "Cole1992": "Cole, S. J., Sayles, R. S. (1992). A numerical model for the contact of layered elastic bodies with real rough surfaces. Journal of Tribology 114, 334-340.",
    "Cooper1969": "Cooper, M. G., Mikic, B. B., Yovanovich, M. M. (1969). Thermal contact conductance. International Journal of Heat and Mass Transfer 12, 279-300.",
    "Cottle1992": "Cottle, R. W., Pang, J.-S., Stone, R. E. (1992). The Linear Complementarity Problem. Academic Press, Boston.",
    "Cowper1957": "Cowper, G. R., Symonds, P. S. (1957). Strain-hardening and strain-rate effects in the impact loading of cantilever beams. Report 28, Division of Applied Mathematics, Brown University.",
    "Dapp2012": "Dapp, W. B., Lücke, A., Persson, B. N. J., Müser, M. H. (2012). Self-affine elastic contacts: percolation and leakage. Physical Review Letters 108, 244301.",
    "DeSaxce1998": "De Saxce, G., Feng, Z.-Q. (1998). The bipotential method: a constructive approach to design the complete contact law with friction and improved numerical algorithms. Mathematical and Computer Modelling 28, 225-245.",
    "DerSimonian1986": "DerSimonian, R., Laird, N. (1986). Meta-analysis in clinical trials. Controlled Clinical Trials 7, 177-188.",
    "Derjaguin1975": "Derjaguin, B. V., Muller, V. M., Toporov, Y. P. (1975). Effect of contact deformations on the adhesion of particles. Journal of Colloid and Interface Science 53, 314-326.",
    "Dieterich1979": "Dieterich, J. H. (1979). Modeling of rock friction: 1. Experimental results and constitutive equations. Journal of Geophysical Research 84, 2161-2168.",
    "Dietrich1997": "Dietrich, C. R., Newsam, G. N. (1997). Fast and exact simulation of stationary Gaussian processes through circulant embedding of the covariance matrix. SIAM Journal on Scientific Computing 18, 1088-1107.",
    "Dundurs1969": "Dundurs, J. (1969). Discussion of Edge-bonded dissimilar orthogonal elastic wedges under normal and shear loading. Journal of Applied Mechanics 36, 650-652.",
    "Dykhne1971": "Dykhne, A. M. (1971). Conductivity of a two-dimensional two-phase system. Soviet Physics JETP 32, 63-65.",
    "Eberly2014": "Eberly, D. (2014). A robust eigensolver for 3 x 3 symmetric matrices. Geometric Tools.",
    "Feng2000": "Feng, J. Q. (2000). Contact behavior of spherical elastic particles: a computational study of particle adhesion and deformations. Colloids and Surfaces A 172, 175-198.",
    "Ferry1980": "Ferry, J. D. (1980). Viscoelastic Properties of Polymers, 3rd ed. Wiley, New York.",
    "Flamant1892": "Flamant, A. (1892). Sur la repartition des pressions dans un solide rectangulaire charge transversalement. Comptes Rendus de l'Academie des Sciences 114, 1465-1468.",
    "Fouvry2003": "Fouvry, S., Liskiewicz, T., Kapsa, P., Hannel, S., Sauger, E. (2003). An energy description of wear mechanisms and its applications to oscillating sliding contacts. Wear 255, 287-298.",
    "Francis1977": "Francis, H. A. (1977). Application of spherical indentation mechanics to reversible and irreversible contact between rough surfaces. Wear 45, 221-269.",
    "Frerot2019": "Frerot, L., Bonnet, M., Molinari, J.-F., Anciaux, G. (2019). A Fourier-accelerated volume integral method for elastoplastic contact. Computer Methods in Applied Mechanics and Engineering 351, 951-976.",
    "Fuller1975": "Fuller, K. N. G., Tabor, D. (1975). The effect of surface roughness on the adhesion of elastic solids. Proceedings of the Royal Society A 345, 327-342.",
    "Galin1961": "Galin, L. A. (1961). Contact Problems in the Theory of Elasticity. North Carolina State College, Raleigh (translation of the Russian edition of 1953).",
    "Galin1976": "Galin, L. A. (1976). Contact problems of the theory of elasticity in the presence of wear. Journal of Applied Mathematics and Mechanics 40, 931-936.",
    "Ganti1995": "Ganti, S., Bhushan, B. (1995). Generalized fractal analysis and its applications to engineering surfaces. Wear 180, 17-34.",
    "Gao1995": "Gao, C., Tian, X., Bhushan, B. (1995). A meniscus model for optimization of texturing and liquid lubrication of magnetic thin-film rigid disks. Tribology Transactions 38, 201-212.",
    "Giles2000": "Giles, M. B., Pierce, N. A. (2000). An introduction to the adjoint approach to design. Flow, Turbulence and Combustion 65, 393-415.",
    "Goodman1962": "Goodman, L. E. (1962). Contact stress analysis of normally loaded rough spheres. Journal of Applied Mechanics 29, 515-522.",
    "Goryacheva1998": "Goryacheva, I. G. (1998). Contact Mechanics in Tribology. Kluwer, Dordrecht.",
    "Greenwood1966": "Greenwood, J. A., Williamson, J. B. P. (1966). Contact of nominally flat surfaces. Proceedings of the Royal Society A 295, 300-319.",
    "Greenwood1970": "Greenwood, J. A., Tripp, J. H. (1970). The contact of two nominally flat rough surfaces. Proceedings of the Institution of Mechanical Engineers 185, 625-633.",
    "Greenwood1997": "Greenwood, J. A. (1997). Adhesion of elastic spheres. Proceedings of the Royal Society A 453, 1277-1297.",
    "Greenwood2006": "Greenwood, J. A. (2006). A simplified elliptic model of rough surface contact. Wear 261, 191-200.",
    "GreenwoodSpots1966": "Greenwood, J. A. (1966). Constriction resistance and the real area of contact. British Journal of Applied Physics 17, 1621-1632.",
    "Guillaumin2022": "Guillaumin, A. P., Sykulski, A. M., Olhede, S. C., Simons, F. J. (2022). The debiased spatial Whittle likelihood. Journal of the Royal Statistical Society B 84, 1526-1557.",
    "Hamilton1983": "Hamilton, G. M. (1983). Explicit equations for the stresses beneath a sliding spherical contact. Proceedings of the Institution of Mechanical Engineers C 197, 53-59.",
    "Hamilton2000": "Hamilton, A. J. S. (2000). Uncorrelated modes of the non-linear power spectrum. Monthly Notices of the Royal Astronomical Society 312, 257-284.",
    "Hearle1985": "Hearle, A. D., Ponter, A. R. S., Johnson, K. L. (1985). The application of shakedown to rolling and sliding point contacts. Journal of the Mechanics and Physics of Solids 33, 339-362.",
    "Helson1958": "Helson, H., Lowdenslager, D. (1958). Prediction theory and Fourier series in several variables. Acta Mathematica 99, 165-202.",
    "Hertz1882": "Hertz, H. (1882). Ueber die Beruehrung fester elastischer Koerper. Journal fuer die reine und angewandte Mathematik 92, 156-171.",
    "Holm1967": "Holm, R. (1967). Electric Contacts: Theory and Application, 4th ed. Springer, Berlin.",
    "HuTonder1992": "Hu, Y. Z., Tonder, K. (1992). Simulation of 3-D random rough surface by 2-D digital filter and Fourier analysis. International Journal of Machine Tools and Manufacture 32, 83-90.",
    "Hunter1961": "Hunter, S. C. (1961). The rolling contact of a rigid cylinder with a viscoelastic half space. Journal of Applied Mechanics 28, 611-617.",
    "Hunter2004": "Hunter, D. R., Lange, K. (2004). A tutorial on MM algorithms. The American Statistician 58, 30-37.",
    "ISO13565-1": "ISO 13565-1:1996. Geometrical Product Specifications (GPS) - Surface texture: Profile method; Surfaces having stratified functional properties - Part 1: Filtering and general measurement conditions.",
    "ISO13565-2": "ISO 13565-2:1996. Geometrical Product Specifications (GPS) - Surface texture: Profile method; Surfaces having stratified functional properties - Part 2: Height characterization using the linear material ratio curve.",
    "ISO16610-21": "ISO 16610-21:2011. Geometrical product specifications (GPS) - Filtration - Part 21: Linear profile filters: Gaussian filters.",
    "ISO16610-22": "ISO 16610-22:2015. Geometrical product specifications (GPS) - Filtration - Part 22: Linear profile filters: Spline filters.",
    "ISO16610-31": "ISO 16610-31:2016. Geometrical product specifications (GPS) - Filtration - Part 31: Robust profile filters: Gaussian regression filters.",
    "ISO16610-61": "ISO 16610-61:2015. Geometrical product specifications (GPS) - Filtration - Part 61: Linear areal filters: Gaussian filters.",
    "ISO16610-71": "ISO 16610-71:2014. Geometrical product specifications (GPS) - Filtration - Part 71: Robust areal filters: Gaussian regression filters.",
    "ISO21920-2": "ISO 21920-2:2021. Geometrical product specifications (GPS) - Surface texture: Profile - Part 2: Terms, definitions and surface texture parameters.",
    "ISO21920-3": "ISO 21920-3:2021. Geometrical product specifications (GPS) - Surface texture: Profile - Part 3: Specification operators.",
    "ISO25178": "ISO 25178-2:2021. Geometrical product specifications (GPS) - Surface texture: Areal - Part 2: Terms, definitions and surface texture parameters.",
    "ISO4287": "ISO 4287:1997. Geometrical Product Specifications (GPS) - Surface texture: Profile method - Terms, definitions and surface texture parameters.",
    "ISO4288": "ISO 4288:1996. Geometrical Product Specifications (GPS) - Surface texture: Profile method - Rules and procedures for the assessment of surface texture.",
    "Israelachvili2011": "Israelachvili, J. N. (2011). Intermolecular and Surface Forces. 3rd ed., Academic Press, Burlington.",
    "Istas1997": "Istas, J., Lang, G. (1997). Quadratic variations and estimation of the local Hölder index of a Gaussian process. Annales de l'Institut Henri Poincaré B 33, 407-436.",
    "Jackson2005": "Jackson, R. L., Green, I. (2005). A finite element study of elasto-plastic hemispherical contact against a rigid flat. Journal of Tribology 127, 343-354.",
    "Jacobs2017": "Jacobs, T. D. B., Junge, T., Pastewka, L. (2017). Quantitative characterization of surface topography using spectral analysis. Surface Topography: Metrology and Properties 5, 013001.",
    "Jacq2002": "Jacq, C., Nelias, D., Lormand, G., Girodin, D. (2002). Development of a three-dimensional semi-analytical elastic-plastic contact code. Journal of Tribology 124, 653-667.",
    "Jaeger1942": "Jaeger, J. C. (1942). Moving sources of heat and the temperature at sliding contacts. Journal and Proceedings of the Royal Society of New South Wales 76, 203-224.",
    "Jager1998": "Jager, J. (1998). A new principle in contact mechanics. Journal of Tribology 120, 677-684.",
    "Johnson1949": "Johnson, N. L. (1949). Systems of frequency curves generated by methods of translation. Biometrika 36, 149-176.",
    "Johnson1962": "Johnson, K. L. (1962). A shakedown limit in rolling contact. Proceedings of the Fourth U.S. National Congress of Applied Mechanics, 971-975.",
    "Johnson1971": "Johnson, K. L., Kendall, K., Roberts, A. D. (1971). Surface energy and the contact of elastic solids. Proceedings of the Royal Society A 324, 301-313.",
    "Johnson1985": "Johnson, K. L. (1985). Contact Mechanics. Cambridge University Press.",
    "Johnson1995": "Johnson, K. L. (1995). The adhesion of two elastic bodies with slightly wavy surfaces. International Journal of Solids and Structures 32, 423-430.",
    "JohnsonCook1983": "Johnson, G. R., Cook, W. H. (1983). A constitutive model and data for metals subjected to large strains, high strain rates and high temperatures. Proceedings of the 7th International Symposium on Ballistics, 541-547.",
    "JohnsonGreenwood1985": "Johnson, K. L., Greenwood, J. A., Higginson, J. G. (1985). The contact of elastic regular wavy surfaces. International Journal of Mechanical Sciences 27, 383-396.",
    "Kalker1967": "Kalker, J. J. (1967). On the rolling contact of two elastic bodies in the presence of dry friction. Dissertation, Delft University of Technology.",
    "Kalker1977": "Kalker, J. J. (1977). Variational principles of contact elastostatics. IMA Journal of Applied Mathematics 20, 199-219.",
    "Kalker1982": "Kalker, J. J. (1982). A fast algorithm for the simplified theory of rolling contact. Vehicle System Dynamics 11, 1-13.",
    "Kalker1990": "Kalker, J. J. (1990). Three-Dimensional Elastic Bodies in Rolling Contact. Kluwer, Dordrecht.",
    "Kauzlarich2001": "Kauzlarich, J. J., Williams, J. A. (2001). Archard wear and component geometry. Proceedings of the Institution of Mechanical Engineers J 215, 387-403.",
    "Keller1964": "Keller, J. B. (1964). A theorem on the conductivity of a composite medium. Journal of Mathematical Physics 5, 548-549.",
    "Keller1991": "Keller, D. (1991). Reconstruction of STM and AFM images distorted by finite-size tips. Surface Science 253, 353-364.",
    "Kennard1938": "Kennard, E. H. (1938). Kinetic Theory of Gases. McGraw-Hill, New York.",
    "Kent1997": "Kent, J. T., Wood, A. T. A. (1997). Estimating the fractal dimension of a locally self-similar Gaussian process by using increments. Journal of the Royal Statistical Society B 59, 679-699.",
    "Kogut2002": "Kogut, L., Etsion, I. (2002). Elastic-plastic contact analysis of a sphere and a rigid flat. Journal of Applied Mechanics 69, 657-662.",
    "Kohlrausch1900": "Kohlrausch, F. (1900). Ueber den stationaeren Temperaturzustand eines elektrisch geheizten Leiters. Annalen der Physik 306, 132-158.",
    "Kohonen1999": "Kohonen, M. M., Maeda, N., Christenson, H. K. (1999). Kinetics of capillary condensation in a nanoscale pore. Physical Review Letters 82, 4667-4670.",
    "Kotwal1996": "Kotwal, C. A., Bhushan, B. (1996). Contact analysis of non-Gaussian surfaces for minimum static and kinetic friction and wear. Tribology Transactions 39, 890-898.",
    "Lawson1974": "Lawson, C. L., Hanson, R. J. (1974). Solving Least Squares Problems. Prentice-Hall, Englewood Cliffs.",
    "Lee1960": "Lee, E. H., Radok, J. R. M. (1960). The contact problem for viscoelastic bodies. Journal of Applied Mechanics 27, 438-444.",
    "Ling1973": "Ling, F. F. (1973). Surface Mechanics. Wiley, New York.",
    "Liu2000": "Liu, S., Wang, Q., Liu, G. (2000). A versatile method of discrete convolution and FFT (DC-FFT) for contact analyses. Wear 243, 101-111.",
    "Liu2002": "Liu, S., Wang, Q. (2002). Studying contact stress fields caused by surface tractions with a discrete convolution and fast Fourier transform algorithm. Journal of Tribology 124, 36-45.",
    "LonguetHiggins1957": "Longuet-Higgins, M. S. (1957). The statistical analysis of a random, moving surface. Philosophical Transactions of the Royal Society A 249, 321-387.",
    "Love1929": "Love, A. E. H. (1929). The stress produced in a semi-infinite solid by pressure on part of the boundary. Philosophical Transactions of the Royal Society A 228, 377-420.",
    "Lubkin1951": "Lubkin, J. L. (1951). The torsion of elastic spheres in contact. Journal of Applied Mechanics 18, 183-187.",
    "Majumdar1990": "Majumdar, A., Bhushan, B. (1990). Role of fractal geometry in roughness characterization and contact mechanics of surfaces. Journal of Tribology 112, 205-216.",
    "Majumdar1991": "Majumdar, A., Bhushan, B. (1991). Fractal model of elastic-plastic contact between rough surfaces. Journal of Tribology 113, 1-11.",
    "Martins1990": "Martins, J. A. C., Oden, J. T., Simoes, F. M. F. (1990). A study of static and kinetic friction. International Journal of Engineering Science 28, 29-92.",
    "Matthewson1988": "Matthewson, M. J., Mamin, H. J. (1988). Liquid-mediated adhesion of ultra-flat solid surfaces. Materials Research Society Symposium Proceedings 119, 87-92.",
    "Maugis1992": "Maugis, D. (1992). Adhesion of spheres: the JKR-DMT transition using a Dugdale model. Journal of Colloid and Interface Science 150, 243-269.",
    "McCool1986": "McCool, J. I. (1986). Comparison of models for the contact of rough surfaces. Wear 107, 37-60.",
    "McCool1987": "McCool, J. I. (1987). Relating profile instrument measurements to the functional performance of rough surfaces. Journal of Tribology 109, 264-270.",
    "McEwen1949": "McEwen, E. (1949). Stresses in elastic cylinders in contact along a generatrix. Philosophical Magazine 40, 454-459.",
    "McFarlane1950": "McFarlane, J. S., Tabor, D. (1950). Adhesion of solids and the effect of surface films. Proceedings of the Royal Society A 202, 224-243.",
    "Mikic1974": "Mikic, B. B. (1974). Thermal contact conductance; theoretical considerations. International Journal of Heat and Mass Transfer 17, 205-214.",
    "Mindlin1949": "Mindlin, R. D. (1949). Compliance of elastic bodies in contact. Journal of Applied Mechanics 16, 259-268.",
    "Mindlin1953": "Mindlin, R. D., Deresiewicz, H. (1953). Elastic spheres in contact under varying oblique forces. Journal of Applied Mechanics 20, 327-344.",
    "Moisan2011": "Moisan, L. (2011). Periodic plus smooth image decomposition. Journal of Mathematical Imaging and Vision 39, 161-179.",
    "Mossakovskii1963": "Mossakovskii, V. I. (1963). Compression of elastic bodies under conditions of adhesion (axisymmetric case). Journal of Applied Mathematics and Mechanics 27, 630-643.",
    "Nayak1971": "Nayak, P. R. (1971). Random process model of rough surfaces. Journal of Lubrication Technology 93, 398-407.",
    "Nikolic1999": "Nikolic, B., Allen, P. B. (1999). Electron transport through a circular constriction. Physical Review B 60, 3963-3969.",
    "Nogi1997": "Nogi, T., Kato, T. (1997). Influence of a hard surface layer on the limit of elastic contact, part I. Journal of Tribology 119, 493-500.",
    "OCallaghan1976": "O'Callaghan, M., Cameron, M. A. (1976). Static contact under load between nominally flat surfaces in which deformation is purely elastic. Wear 36, 79-97.",
    "ODonoghue2015": "O'Donoghue, B., Candes, E. (2015). Adaptive restart for accelerated gradient schemes. Foundations of Computational Mathematics 15, 715-732.",
    "OSullivan1988": "O'Sullivan, T. C., King, R. B. (1988). Sliding contact stress field due to a spherical indenter on a layered elastic half-space. Journal of Tribology 110, 235-240.",
    "Oden1985": "Oden, J. T., Martins, J. A. C. (1985). Models and computational methods for dynamic friction phenomena. Computer Methods in Applied Mechanics and Engineering 52, 527-634.",
    "Oliver1992": "Oliver, W. C., Pharr, G. M. (1992). An improved technique for determining hardness and elastic modulus using load and displacement sensing indentation experiments. Journal of Materials Research 7, 1564-1583.",
    "Onions1973": "Onions, R. A., Archard, J. F. (1973). The contact of surfaces having a random structure. Journal of Physics D 6, 289-304.",
    "Orr1975": "Orr, F. M., Scriven, L. E., Rivas, A. P. (1975). Pendular rings between solids: meniscus properties and capillary force. Journal of Fluid Mechanics 67, 723-742.",
    "Panagiotopoulos1975": "Panagiotopoulos, P. D. (1975). A nonlinear programming approach to the unilateral contact- and friction-boundary value problem in the theory of elasticity. Ingenieur-Archiv 44, 421-432.",
    "Park1999": "Park, S. W., Schapery, R. A. (1999). Methods of interconversion between linear viscoelastic material functions. Part I: a numerical method based on Prony series. International Journal of Solids and Structures 36, 1653-1675.",
    "PastewkaRobbins2014": "Pastewka, L., Robbins, M. O. (2014). Contact between rough surfaces and a criterion for macroscopic adhesion. Proceedings of the National Academy of Sciences 111, 3298-3303.",
    "PatirCheng1978": "Patir, N., Cheng, H. S. (1978). An average flow model for determining effects of three-dimensional roughness on partial hydrodynamic lubrication. Journal of Lubrication Technology 100, 12-17.",
    "PatirCheng1979": "Patir, N., Cheng, H. S. (1979). Application of average flow model to lubrication between rough sliding surfaces. Journal of Lubrication Technology 101, 220-229.",
    "Pearson1895": "Pearson, K. (1895). Contributions to the mathematical theory of evolution. II. Skew variation in homogeneous material. Philosophical Transactions of the Royal Society A 186, 343-414.",
    "Pearson1916": "Pearson, K. (1916). Mathematical contributions to the theory of evolution. XIX. Second supplement to a memoir on skew variation. Philosophical Transactions of the Royal Society A 216, 429-457.",
    "Peng2001": "Peng, W. (2001). Contact mechanics of multilayered rough surfaces in tribology. Dissertation, Ohio State University.",
    "PengBhushan2000": "Peng, W., Bhushan, B. (2000). Modelling of surfaces with a bimodal roughness distribution. Proceedings of the Institution of Mechanical Engineers J 214, 459-470.",
    "PengBhushan2001": "Peng, W., Bhushan, B. (2001). A numerical three-dimensional model for the contact of layered elastic/plastic solids with rough surfaces by a variational principle. Journal of Tribology 123, 330-342.",
    "PerezRafols2019": "Perez-Rafols, F., Almqvist, A. (2019). Generating randomly rough surfaces with given height probability distribution and power spectrum. Tribology International 131, 591-604.",
    "Perrins1979": "Perrins, W. T., McKenzie, D. R., McPhedran, R. C. (1979). Transport properties of regular arrays of cylinders. Proceedings of the Royal Society A 369, 207-225.",
    "Persson1964": "Persson, A. (1964). On the stress distribution of cylindrical elastic bodies in contact. Dissertation, Chalmers University of Technology, Göteborg.",
    "Persson2001": "Persson, B. N. J. (2001). Theory of rubber friction and contact mechanics. Journal of Chemical Physics 115, 3840-3861.",
    "Persson2002": "Persson, B. N. J., Bucher, F., Chiaia, B. (2002). Elastic contact between randomly rough surfaces: comparison of theory with numerical results. Physical Review B 65, 184106.",
    "Persson2007": "Persson, B. N. J. (2007). Relation between interfacial separation and load: a general theory of contact mechanics. Physical Review Letters 99, 125502.",
    "PerssonTosatti2001": "Persson, B. N. J., Tosatti, E. (2001). The effect of surface roughness on the adhesion of elastic solids. Journal of Chemical Physics 115, 5597-5610.",
    "PerssonYang2008": "Persson, B. N. J., Yang, C. (2008). Theory of the leak-rate of seals. Journal of Physics: Condensed Matter 20, 315011.",
    "PohrtPopov2015": "Pohrt, R., Popov, V. L. (2015). Adhesive contact simulation of elastic solids using local mesh-dependent detachment criterion in boundary elements method. Facta Universitatis, Series: Mechanical Engineering 13, 3-10.",
    "Polonsky1999": "Polonsky, I. A., Keer, L. M. (1999). A numerical method for solving rough contact problems based on the multi-level multi-summation and conjugate gradient techniques. Wear 231, 206-219.",
    "Poon1995": "Poon, C. Y., Bhushan, B. (1995). Comparison of surface roughness measurements by stylus profiler, AFM and non-contact optical profiler. Wear 190, 76-88.",
    "Popov2015": "Popov, V. L., Hess, M. (2015). Method of Dimensionality Reduction in Contact Mechanics and Friction. Springer, Berlin.",
    "Rabier1986": "Rabier, P., Martins, J. A. C., Oden, J. T., Campos, L. (1986). Existence and local uniqueness of solutions to contact problems in elasticity with nonlinear friction laws. International Journal of Engineering Science 24, 1755-1768.",
    "Rannacher1984": "Rannacher, R. (1984). Finite element solution of diffusion problems with irregular data. Numerische Mathematik 43, 309-327.",
    "Rey2017": "Rey, V., Anciaux, G., Molinari, J.-F. (2017). Normal adhesive contact on rough surfaces: efficient algorithm for FFT-based BEM resolution. Computational Mechanics 60, 69-81.",
    "Reynolds1886": "Reynolds, O. (1886). On the theory of lubrication and its application to Mr. Beauchamp Tower's experiments, including an experimental determination of the viscosity of olive oil. Philosophical Transactions of the Royal Society 177, 157-234.",
    "RiceRuina1983": "Rice, J. R., Ruina, A. L. (1983). Stability of steady frictional slipping. Journal of Applied Mechanics 50, 343-349.",
    "Roettger2022": "Roettger, M. C., Sanner, A., Thimons, L. A., et al. (2022). contact.engineering - Create, analyze and publish digital surface twins from topography measurements across many scales. Surface Topography: Metrology and Properties 10, 035032.",
    "Rosenthal1946": "Rosenthal, D. (1946). The theory of moving sources of heat and its application to metal treatments. Transactions of the ASME 68, 849-866.",
    "Ruina1983": "Ruina, A. (1983). Slip instability and state variable friction laws. Journal of Geophysical Research 88, 10359-10370.",
    "Salmon2011": "Salmon, J. K., Moraes, M. A., Dror, R. O., Shaw, D. E. (2011). Parallel random numbers: as easy as 1, 2, 3. Proceedings of the International Conference for High Performance Computing (SC11), 16.",
    "Sanner2022": "Sanner, A., Nohring, W. G., Thimons, L. A., Jacobs, T. D. B., Pastewka, L. (2022). Scale-dependent roughness parameters for topography analysis. Applied Surface Science Advances 7, 100190.",
    "Schreiber1996": "Schreiber, T., Schmitz, A. (1996). Improved surrogate data for nonlinearity tests. Physical Review Letters 77, 635-638.",
    "Sharvin1965": "Sharvin, Yu. V. (1965). A possible method for studying Fermi surfaces. Soviet Physics JETP 21, 655-656.",
    "Shen1983": "Shen, Z. Y., Hedrick, J. K., Elkins, J. A. (1983). A comparison of alternative creep force models for rail vehicle dynamic analysis. Vehicle System Dynamics 12, 79-83.",
    "SimoTaylor1985": "Simo, J. C., Taylor, R. L. (1985). Consistent tangent operators for rate-independent elastoplasticity. Computer Methods in Applied Mechanics and Engineering 48, 101-118.",
    "Sneddon1965": "Sneddon, I. N. (1965). The relation between load and penetration in the axisymmetric Boussinesq problem for a punch of arbitrary profile. International Journal of Engineering Science 3, 47-57.",
    "Spence1968": "Spence, D. A. (1968). Self similar solutions to adhesive contact problems with incremental loading. Proceedings of the Royal Society A 305, 55-80.",
    "Spence1973": "Spence, D. A. (1973). An eigenvalue problem for elastic contact with finite friction. Mathematical Proceedings of the Cambridge Philosophical Society 73, 249-268.",
    "Spence1975": "Spence, D. A. (1975). The Hertz contact problem with finite friction. Journal of Elasticity 5, 297-319.",
    "Squire1998": "Squire, W., Trapp, G. (1998). Using complex variables to estimate derivatives of real functions. SIAM Review 40, 110-112.",
    "Stanley1997": "Stanley, H. M., Kato, T. (1997). An FFT-based method for rough surface contact. Journal of Tribology 119, 481-485.",
    "Steihaug1983": "Steihaug, T. (1983). The conjugate gradient method and trust regions in large scale optimization. SIAM Journal on Numerical Analysis 20, 626-637.",
    "Steuermann1939": "Steuermann, E. (1939). To Hertz's theory of local deformations in compressed elastic bodies. Comptes Rendus de l'Académie des Sciences de l'URSS 25, 359-361.",
    "Sykulski2019": "Sykulski, A. M., Olhede, S. C., Guillaumin, A. P., Lilly, J. M., Early, J. J. (2019). The debiased Whittle likelihood. Biometrika 106, 251-266.",
    "Tabor1951": "Tabor, D. (1951). The Hardness of Metals. Clarendon Press, Oxford.",
    "Tabor1977": "Tabor, D. (1977). Surface forces and surface interactions. Journal of Colloid and Interface Science 58, 2-13.",
    "Takahasi1974": "Takahasi, H., Mori, M. (1974). Double exponential formulas for numerical integration. Publications of the Research Institute for Mathematical Sciences 9, 721-741.",
    "Tan2006": "Tan, E. L. (2006). Hybrid compliance-stiffness matrix method for stable analysis of elastic wave propagation in multilayered anisotropic media. Journal of the Acoustical Society of America 119, 45-53.",
    "Tian1996": "Tian, X., Bhushan, B. (1996). A numerical three-dimensional model for the contact of rough surfaces by variational principle. Journal of Tribology 118, 33-42.",
    "TianBhushan1996": "Tian, X., Bhushan, B. (1996). The micro-meniscus effect of a thin liquid film on the static friction of rough surface contact. Journal of Physics D 29, 163-178.",
    "TianKennedy1994": "Tian, X., Kennedy, F. E. (1994). Maximum and average flash temperatures in sliding contacts. Journal of Tribology 116, 167-174.",
    "Ting1966": "Ting, T. C. T. (1966). The contact stresses between a rigid indenter and a viscoelastic half-space. Journal of Applied Mechanics 33, 845-854.",
    "Tuenter2001": "Tuenter, H. J. H. (2001). An algorithm to determine the parameters of SU-curves in the Johnson system of probability distributions by moment matching. Journal of Statistical Computation and Simulation 70, 325-347.",
    "Vermeulen1964": "Vermeulen, P. J., Johnson, K. L. (1964). Contact of nonspherical elastic bodies transmitting tangential forces. Journal of Applied Mechanics 31, 338-340.",
    "Villarrubia1997": "Villarrubia, J. S. (1997). Algorithms for scanned probe microscope image simulation, surface reconstruction, and tip estimation. Journal of Research of the National Institute of Standards and Technology 102, 425-454.",
    "Weibull1951": "Weibull, W. (1951). A statistical distribution function of wide applicability. Journal of Applied Mechanics 18, 293-297.",
    "Westergaard1939": "Westergaard, H. M. (1939). Bearing pressures and cracks. Journal of Applied Mechanics 6, A49-A53.",
    "Wexler1966": "Wexler, G. (1966). The size effect and the non-local Boltzmann transport equation in orifice and disk geometry. Proceedings of the Physical Society 89, 927-941.",
    "Whitehouse1970": "Whitehouse, D. J., Archard, J. F. (1970). The properties of random surfaces of significance in their contact. Proceedings of the Royal Society A 316, 97-121.",
    "Whitehouse1978": "Whitehouse, D. J., Phillips, M. J. (1978). Discrete properties of random surfaces. Philosophical Transactions of the Royal Society A 290, 267-298.",
    "Whittle1953": "Whittle, P. (1953). Estimation and information in stationary time series. Arkiv for Matematik 2, 423-434.",
    "Williams1955": "Williams, M. L., Landel, R. F., Ferry, J. D. (1955). The temperature dependence of relaxation mechanisms in amorphous polymers and other glass-forming liquids. Journal of the American Chemical Society 77, 3701-3707.",
    "Wu2000": "Wu, J.-J. (2000). Simulation of rough surfaces with FFT. Tribology International 33, 47-58.",
    "Yan1998": "Yan, W., Komvopoulos, K. (1998). Contact analysis of elastic-plastic fractal surfaces. Journal of Applied Physics 84, 3617-3624.",
    "Yang2008": "Yang, C., Persson, B. N. J. (2008). Contact mechanics: contact area and interfacial separation from small contact to full contact. Journal of Physics: Condensed Matter 20, 215214.",
    "Yastrebov2017": "Yastrebov, V. A., Anciaux, G., Molinari, J.-F. (2017). On the accurate computation of the true contact-area in mechanical contact of random rough surfaces. Tribology International 114, 161-171.",
    "Yovanovich1982": "Yovanovich, M. M. (1982). Thermal contact correlations. In: Spacecraft Radiative Transfer and Temperature Control (ed. T. E. Horton), Progress in Astronautics and Aeronautics 83, 83-95.",
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
    """Text with one full reference a line for everything the ``objects`` (surface, problem, result,
    …) rest on.

    Raises
    ------
    InputError
        If an object names a paper that is not in the list.
    """
    return "\n".join(f"[{key}] {reference(key)}" for key in citation_keys(*objects))


# Where heights come from: their source, every step of preparation, and the papers behind them.


@dataclass(frozen=True)
class Origin:
    """Where a surface comes from.

    ``source`` file name or generator; ``channel`` data channel; ``instrument`` free key-value data
    from the file; ``history`` one sentence for every preparation step, oldest first;
    ``citation_keys`` the papers behind the reader, the generator and the steps; ``findings`` what
    is doubtful in the file.
    """

    source: str = ""
    channel: str = ""
    instrument: Mapping[str, str] = field(default_factory=dict)
    history: tuple[str, ...] = ()
    citation_keys: tuple[str, ...] = ()
    findings: tuple[Advice, ...] = ()

    def continued(self, step: str, citation_keys: tuple[str, ...] = ()) -> Origin:
        """Origin after a further ``step``, which rests on the papers ``citation_keys``."""
        keys = tuple(dict.fromkeys((*self.citation_keys, *citation_keys)))
        return replace(self, history=(*self.history, step), citation_keys=keys)
