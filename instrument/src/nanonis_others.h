// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

// Functions of Nanonis' protocol that this microscope does not have, by the size of what they return: a client looks
// for the error behind as many bytes, counting lists and texts as empty (Nanonis TCP protocol, SPECS, 2021 and 2024). A
// function that returns nothing has no row.
namespace afm::instrument {

struct OtherFunctions {
  std::size_t bytes;
  std::string_view names;  // between spaces
};

inline constexpr std::array kOtherFunctions{
    OtherFunctions{
        2,
        " AtomTrack.StatusGet BiasSpectr.DigSyncGet BiasSpectr.ZOffRevertGet Osci2T.OversamplGet "
        "OsciHR.CalibrModeGet OsciHR.PSDAvrgTypeGet OsciHR.PSDWeightGet OsciHR.PSDWindowGet "
        "OsciHR.TrigArmModeGet OsciHR.TrigDigSlopeGet OsciHR.TrigLevSlopeGet OsciHR.TrigModeGet "
        "PLL.DemodFilterGet PLL.DemodHarmonicGet PLL.ExcRangeGet SafeTip.OnOffGet SpectrumAnlzr.FFTWindowGet "
        "UserOut.ModeGet ZSpectr.DigSyncGet "},
    OtherFunctions{4,
                   " APRFGen.FreqGet APRFGen.PowerGet APRFGen.RFOutOnOffGet BiasSpectr.MLSLockinPerSegGet "
                   "BiasSpectr.MLSModeGet BiasSpectr.MLSValsGet BiasSpectr.StatusGet Current.100Get Current.BEEMGet "
                   "DataLog.ChsGet DigLines.TTLValGet FolMe.PSOnOffGet GenPICtrl.AOValGet GenPICtrl.DemodChGet "
                   "GenPICtrl.ModChGet GenPICtrl.OnOffGet GenSwp.AcqChsGet HSSwp.EndSettlGet HSSwp.ResetSignalsGet "
                   "HSSwp.SaveBasenameGet HSSwp.SaveDataGet HSSwp.StatusGet HSSwp.SwpChBwdDelayGet HSSwp.SwpChBwdSwGet "
                   "HSSwp.SwpChNumPtsGet Interf.CtrlOnOffGet Interf.ValGet Interf.WPiezoGet KelvinCtrl.AmpGet "
                   "KelvinCtrl.CtrlOnOffGet KelvinCtrl.CtrlSignalGet KelvinCtrl.ModOnOffGet KelvinCtrl.SetpntGet "
                   "Laser.OnOffGet Laser.PowerGet Laser.PropsGet LockIn.DemodHarmonicGet LockIn.DemodPhasGet "
                   "LockIn.DemodPhasRegGet LockIn.DemodRTSignalsGet LockIn.DemodSignalGet LockIn.DemodSyncFilterGet "
                   "LockIn.ModAmpGet LockIn.ModHarmonicGet LockIn.ModOnOffGet LockIn.ModPhasGet LockIn.ModPhasRegGet "
                   "LockIn.ModSignalGet LockInFreqSwp.SignalGet Marks.LinesGet OsciHR.ChGet OsciHR.OversamplGet "
                   "OsciHR.PSDAvrgCountGet OsciHR.PreTrigGet OsciHR.SamplesGet OsciHR.TrigDigChGet OsciHR.TrigLevChGet "
                   "PLL.AddOnOffGet PLL.AmpCtrlBandwidthGet PLL.AmpCtrlOnOffGet PLL.AmpCtrlSetpntGet PLL.DemodInputGet "
                   "PLL.DemodPhasRefGet PLL.ExcitationGet PLL.FreqRangeGet PLL.FreqShiftGet PLL.InpCalibrGet "
                   "PLL.InpPropsGet PLL.InpRangeGet PLL.OutOnOffGet PLL.PhasCtrlBandwidthGet PLL.PhasCtrlOnOffGet "
                   "PLLSignalAnlzr.ChGet PLLZoomFFT.ChGet Pattern.CloudGet Pattern.ExpStatusGet SafeTip.SignalGet "
                   "Scan.BackgroundDelete Scan.BackgroundPaste Scan.Save Script.ChsGet SpectrumAnlzr.ACCouplingGet "
                   "SpectrumAnlzr.ChGet TCPLog.StatusGet TipRec.BufferSizeGet UserOut.CalcSignalNameGet "
                   "UserOut.MonitorChGet Util.AcqPeriodGet Util.RTFreqGet Util.SessionPathGet ZCtrl.LimitsEnabledGet "
                   "ZCtrl.SwitchOffDelayGet ZCtrl.TipLiftGet ZCtrl.WithdrawRateGet ZSpectr.RetractDelayGet "
                   "ZSpectr.StatusGet "},
    OtherFunctions{
        6,
        " BiasSpectr.PulseSeqSyncGet Osci1T.TimebaseSet SpectrumAnlzr.FreqResGet UserOut.CalcSignalConfigGet "
        "ZCtrl.HomePropsGet ZSpectr.PulseSeqSyncGet "},
    OtherFunctions{
        8,
        " APRFGen.FreqSwpLimitsGet APRFGen.PowerSwpLimitsGet Bias.CalibrGet BiasSpectr.AdvPropsGet "
        "BiasSpectr.ChsGet BiasSpectr.LimitsGet FolMe.OversamplGet GenSwp.LimitsGet HSSwp.NumSweepsGet "
        "HSSwp.SwpChSignalGet KelvinCtrl.BiasLimitsGet LockIn.DemodHPFilterGet LockIn.DemodLPFilterGet "
        "LockIn.ModPhasFreqGet LockInFreqSwp.LimitsGet Marks.PointsGet Motor.FreqAmpGet OCSync.LinkAnglesGet "
        "Osci1T.ChGet OsciHR.TrigLevHystGet OsciHR.TrigLevValGet PLL.CenterFreqGet PLL.FreqExcOverwriteGet "
        "PLL.PhasCtrlGainGet Piezo.TiltGet SafeTip.PropsGet Scan.XYPosGet Script.DataGet SignalChart.ChsGet "
        "Signals.CalibrGet Signals.MeasNamesGet Signals.RangeGet SpectrumAnlzr.AveragGet SpectrumAnlzr.DCGet "
        "SpectrumAnlzr.FreqRangeGet UserOut.LimitsGet ZCtrl.LimitsGet ZSpectr.ChsGet ZSpectr.RangeGet "},
    OtherFunctions{10,
                   " Bias.RangeGet BiasSpectr.AltZCtrlGet FolMe.PSExpGet KelvinCtrl.GainGet PLLSignalAnlzr.FFTPropsGet "
                   "PLLZoomFFT.PropsGet ZSpectr.AdvPropsGet "},
    OtherFunctions{
        12,
        " BiasSpectr.TTLSyncGet CPDComp.ParamsGet GenSwp.SwpSignalGet HSSwp.SaveOptionsGet "
        "HSSwp.SwpChLimitsGet Interf.CtrlPropsGet KelvinCtrl.ModParamsGet Motor.StepCounterGet "
        "PLL.AmpCtrlGainGet PLLFreqSwp.ParamsGet Piezo.CalibrGet Piezo.RangeGet Piezo.SensGet TipRec.DataGet "
        "ZCtrl.CtrlListGet ZSpectr.RetractGet ZSpectr.TTLSyncGet "},
    OtherFunctions{14, " APRFGen.TrigPropsGet GenPICtrl.PropsGet ZSpectr.RetractSecondGet "},
    OtherFunctions{16,
                   " BeamDefl.HorConfigGet BeamDefl.IntConfigGet BeamDefl.VerConfigGet BiasSwp.Start Current.CalibrGet "
                   "GenSwp.Start HSSwp.AcqChsGet HSSwp.SwpChTimingGet LockInFreqSwp.Start OCSync.AnglesGet "
                   "PLLPhasSwp.Start PLLSignalAnlzr.TimebaseGet Piezo.HVAStatusLEDGet Signals.AddRTGet "},
    OtherFunctions{18, " APRFGen.ListSwpPropsGet "},
    OtherFunctions{20,
                   " APRFGen.PowerSwpPropsGet AtomTrack.PropsGet BiasSpectr.Start FolMe.PSPropsGet HSSwp.ZCtrlOffGet "
                   "Osci1T.DataGet OsciHR.OsciDataGet PLLSignalAnlzr.FFTDataGet PLLSignalAnlzr.OsciDataGet "
                   "PLLZoomFFT.DataGet Pattern.LineGet ZSpectr.Start "},
    OtherFunctions{22, " APRFGen.FreqSwpPropsGet "},
    OtherFunctions{24,
                   " Current.GainsGet DataLog.StatusGet GenPICtrl.AOPropsGet Motor.PosGet Osci2T.DataGet "
                   "OsciHR.PSDDataGet Pattern.PropsGet SpectrumAnlzr.BandRMSGet SpectrumAnlzr.CursorPosGet "},
    OtherFunctions{26, " DataLog.PropsGet GenSwp.PropsGet LockInFreqSwp.PropsGet ZSpectr.PropsGet "},
    OtherFunctions{28, " CPDComp.DataGet Pattern.GridGet Piezo.HVAInfoGet ZSpectr.TimingGet "},
    OtherFunctions{30, " Osci2T.TrigGet "},
    OtherFunctions{32, " BiasSpectr.TimingGet HSSwp.AutoReverseGet Piezo.DriftCompGet "},
    OtherFunctions{34, " PLLSignalAnlzr.TrigGet "},
    OtherFunctions{36, " BiasSpectr.PropsGet "},
    OtherFunctions{44, " TipShaper.PropsGet "},
    OtherFunctions{48, " PLLFreqSwp.Start "},
    OtherFunctions{80, " SpectrumAnlzr.DataGet "}};

// Bytes of the results of a function that this microscope does not have; 0 for an unknown one.
inline std::size_t result_size_of_other(std::string_view name) {
  const std::string word = " " + std::string(name) + " ";
  for (const OtherFunctions& row : kOtherFunctions) {
    if (row.names.find(word) != std::string_view::npos) return row.bytes;
  }
  return 0;
}

}  // namespace afm::instrument
