# SPDX-License-Identifier: Apache-2.0
"""The hopper in air as a case of OpenFOAM's twoPhaseEulerFoam (v1912, Debian's package openfoam): both phases continua
that pass through each other, the grains by the kinetic theory of granular flow with the frictional stress of Johnson and
Jackson, which together are what this solver offers for dense grains. The mesh is that of Talus's air: 80 x 4 x 200 cells.
"""
from pathlib import Path

WIDTH, DEPTH, HEIGHT, PLATE, SLIT, BED = 0.1, 0.005, 0.25, 0.1, (0.03, 0.07), 0.083333333  # m
CELL = 1.25e-3  # m
PACKING = 0.6
WALLS = ("sides", "floor", "plate")
PATCHES = WALLS + ("top", "front")

HEADER = "FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"


def mesh():
    """blockMeshDict: three blocks below the plate and three above. At the plate's solid parts the blocks have vertices of
    their own, so that their faces are walls; at the slit they share them."""
    columns, points, index = (0, SLIT[0], SLIT[1], WIDTH), [], {}

    def vertex(x, y, z, level):
        shared = z == PLATE and x in SLIT
        key = (x, y, z, None if shared else level)
        if key not in index:
            index[key] = len(points)
            points.append((x, y, z))
        return index[key]

    blocks, patches = [], {name: [] for name in PATCHES}
    for level, (low, high) in enumerate(((0, PLATE), (PLATE, HEIGHT))):
        for column, (left, right) in enumerate(zip(columns, columns[1:])):
            v = [vertex(x, y, z, level) for z in (low, high)
                 for x, y in ((left, 0), (right, 0), (right, DEPTH), (left, DEPTH))]
            counts = [round((right - left) / CELL), round(DEPTH / CELL), round((high - low) / CELL)]
            blocks.append(f"hex ({' '.join(map(str, v))}) ({' '.join(map(str, counts))}) simpleGrading (1 1 1)")
            bottom, top = (v[0], v[3], v[2], v[1]), (v[4], v[5], v[6], v[7])
            patches["front"] += [(v[0], v[1], v[5], v[4]), (v[3], v[7], v[6], v[2])]
            if column == 0:
                patches["sides"].append((v[0], v[4], v[7], v[3]))
            if column == 2:
                patches["sides"].append((v[1], v[2], v[6], v[5]))
            if level == 0:
                patches["floor"].append(bottom)
            else:
                patches["top"].append(top)
            if column != 1:
                patches["plate"].append(top if level == 0 else bottom)
    kinds = {"front": "symmetry", "top": "patch"}
    faces = "\n".join(f"{name} {{ type {kinds.get(name, 'wall')}; faces ("
                      + " ".join(f"({' '.join(map(str, face))})" for face in found) + "); }"
                      for name, found in patches.items())
    places = " ".join(f"({x} {y} {z})" for x, y, z in points)
    return (f"scale 1;\nvertices ({places});\nblocks (\n" + "\n".join(blocks)
            + f"\n);\nedges ();\nboundary (\n{faces}\n);\nmergePatchPairs ();\n")


def field(name, dimensions, inside, walls, top, vector=False):
    """A file of the folder 0."""
    kind = "volVectorField" if vector else "volScalarField"
    boundaries = "\n".join([f"{wall} {{ {walls} }}" for wall in WALLS]
                           + [f"top {{ {top} }}", "front { type symmetry; }"])
    return name, (HEADER.format(kind=kind, name=name)
                  + f"dimensions {dimensions};\ninternalField uniform {inside};\nboundaryField {{\n{boundaries}\n}}\n")


def fields():
    zero, none = "(0 0 0)", "[0 0 0 0 0 0 0]"
    calculated = "type calculated; value uniform 0;"
    atmosphere = "type calculated; value uniform 101325;"
    flat = "type zeroGradient;"
    still = f"type fixedValue; value uniform {zero};"
    return dict([
        field("alpha.particles", none, 0, flat, flat),
        field("U.particles", "[0 1 -1 0 0 0 0]", zero, "type slip;", still, True),
        field("U.air", "[0 1 -1 0 0 0 0]", zero, "type noSlip;",
              f"type pressureInletOutletVelocity; phi phi.air; value uniform {zero};", True),
        field("T.particles", "[0 0 0 1 0 0 0]", 293, flat, flat),
        field("T.air", "[0 0 0 1 0 0 0]", 293, flat,
              "type inletOutlet; phi phi.air; inletValue uniform 293; value uniform 293;"),
        field("Theta.particles", "[0 2 -2 0 0 0 0]", 1e-6, flat, flat),
        field("p", "[1 -1 -2 0 0 0 0]", 101325, atmosphere, atmosphere),
        field("p_rgh", "[1 -1 -2 0 0 0 0]", 101325, "type fixedFluxPressure; value uniform 101325;",
              "type prghPressure; p uniform 101325; value uniform 101325;"),
        field("alphat.particles", "[1 -1 -1 0 0 0 0]", 0, calculated, calculated),
        field("nut.particles", "[0 2 -1 0 0 0 0]", 0, calculated, calculated),
    ])


PHASES = """
phases (particles air);
particles { diameterModel constant; constantCoeffs { d 2e-4; } alphaMax 0.64; residualAlpha 1e-6; }
air { diameterModel constant; constantCoeffs { d 1; } residualAlpha 0; }
blending { default { type none; continuousPhase air; } }
sigma ( (particles and air) 0 );
aspectRatio ();
drag ( (particles in air) { type GidaspowErgunWenYu; residualRe 1e-3; swarmCorrection { type none; } } );
virtualMass ();
heatTransfer ( (particles in air) { type RanzMarshall; residualAlpha 1e-3; } );
lift ();
wallLubrication ();
turbulentDispersion ();
pMin 10000;
"""

GAS = """
thermoType { type heRhoThermo; mixture pureMixture; transport const; thermo hConst; equationOfState perfectGas;
  specie specie; energy sensibleInternalEnergy; }
mixture { specie { molWeight 28.9; } thermodynamics { Cp 1007; Hf 0; } transport { mu 1.8e-5; Pr 0.7; } }
"""

GLASS = """
thermoType { type heRhoThermo; mixture pureMixture; transport const; thermo hConst; equationOfState rhoConst;
  specie specie; energy sensibleInternalEnergy; }
mixture { specie { molWeight 100; } equationOfState { rho 2500; } thermodynamics { Cp 800; Hf 0; }
  transport { mu 0; Pr 1; } }
"""

KINETIC = """
simulationType RAS;
RAS
{
  RASModel kineticTheory; turbulence on; printCoeffs off;
  kineticTheoryCoeffs
  {
    equilibrium on; e 0.8; alphaMax 0.64; alphaMinFriction 0.5; residualAlpha 1e-4;
    viscosityModel Gidaspow; conductivityModel Gidaspow; granularPressureModel Lun;
    frictionalStressModel JohnsonJackson; radialModel SinclairJackson;
    JohnsonJacksonCoeffs { Fr 0.05; eta 2; p 5; phi 30; alphaDeltaMin 0.05; }
  }
}
"""

SCHEMES = """
ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes
{
  default none;
  "div\\\\(phi,alpha.*\\\\)" Gauss vanLeer;
  "div\\\\(phir,alpha.*\\\\)" Gauss vanLeer;
  "div\\\\(alphaRhoPhi.*,U.*\\\\)" Gauss limitedLinearV 1;
  "div\\\\(phi.*,U.*\\\\)" Gauss limitedLinearV 1;
  "div\\\\(alphaRhoPhi.*,(h|e|K).*\\\\)" Gauss limitedLinear 1;
  "div\\\\(alphaPhi.*,p\\\\)" Gauss limitedLinear 1;
  div((((alpha.air*thermo:rho.air)*nuEff.air)*dev2(T(grad(U.air))))) Gauss linear;
  div((((thermo:rho.particles*nut.particles)*dev2(T(grad(U.particles))))+(((thermo:rho.particles*lambda.particles)*div(phi.particles))*I))) Gauss linear;
}
laplacianSchemes { default Gauss linear uncorrected; }
interpolationSchemes { default linear; }
snGradSchemes { default uncorrected; }
""".replace("\\\\", "\\")

SOLUTION = """
solvers
{
  "alpha.*" { nAlphaCorr 1; nAlphaSubCycles 2; implicitPhasePressure yes; solver smoothSolver; smoother symGaussSeidel;
    tolerance 1e-9; relTol 0; minIter 1; }
  p_rgh { solver GAMG; smoother DIC; tolerance 1e-6; relTol 0.01; }
  p_rghFinal { $p_rgh; relTol 0; }
  "(U|h|e|Theta).*" { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-6; relTol 0; minIter 1; }
}
PIMPLE { nOuterCorrectors 1; nCorrectors 2; nNonOrthogonalCorrectors 0; }
relaxationFactors { equations { ".*" 1; } }
"""


def write(folder, end):
    """Writes the case. end: simulated time, s."""
    folder = Path(folder)
    control = (f"application twoPhaseEulerFoam; startFrom startTime; startTime 0; stopAt endTime; endTime {end};\n"
               "deltaT 1e-5; adjustTimeStep yes; maxCo 0.5; maxDeltaT 1e-3;\n"
               f"writeControl adjustableRunTime; writeInterval {end}; writeFormat ascii; timePrecision 6;\n")
    bed = (f"defaultFieldValues ( volScalarFieldValue alpha.particles 0 );\nregions ( boxToCell {{ box (-1 -1 {PLATE}) "
           f"(1 1 {PLATE + BED}); fieldValues ( volScalarFieldValue alpha.particles {PACKING} ); }} );\n")
    files = {"system/blockMeshDict": mesh(), "system/controlDict": control, "system/fvSchemes": SCHEMES,
             "system/fvSolution": SOLUTION, "system/setFieldsDict": bed,
             "constant/phaseProperties": PHASES, "constant/thermophysicalProperties.air": GAS,
             "constant/thermophysicalProperties.particles": GLASS,
             "constant/turbulenceProperties.air": "simulationType laminar;\n",
             "constant/turbulenceProperties.particles": KINETIC,
             "constant/g": "dimensions [0 1 -2 0 0 0 0];\nvalue (0 0 -9.8);\n"}
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        kind = "uniformDimensionedVectorField" if path.name == "g" else "dictionary"
        path.write_text(HEADER.format(kind=kind, name=path.name) + text, encoding="utf-8")
    for name, text in fields().items():
        path = folder / "0" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
