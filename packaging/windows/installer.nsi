; setup.exe for Windows 10 and 11: for one user, without administrator's rights. build.py calls makensis, and hands
; over all names, versions and paths.
;
; setup.exe /S [/DESKTOP] [/D=FOLDER]     installs without a question; /D comes last and takes no quotes
; "Uninstall NAME.exe" /S                       takes the program away; settings and recovery copies stay
;
; Exit status: 0 done, 1 cancelled, 2 could not write, 3 Windows is too old, 4 the program is open, 5 the folder holds
; other files.

Unicode true
Target amd64-unicode
SetCompressor /SOLID lzma
SetCompressorDictSize 64
RequestExecutionLevel user
ManifestDPIAware true
ManifestSupportedOS {8e0f7a12-bfb3-4fe8-b9a5-48fd50a15a9a}
AllowSkipFiles off
ShowInstDetails nevershow
ShowUninstDetails nevershow

!define KEY "Software\${NAME}"
!define CLASSES "Software\Classes"
!define APPS "Software\Microsoft\Windows\CurrentVersion\Uninstall\${NAME}"
!define UNINSTALLER "Uninstall ${NAME}.exe"
!define LIBRARY "runtime\${LIBRARY_NAME}"
!define SECONDS_TO_WAIT 30

Name "${NAME}"
BrandingText "${NAME} ${VERSION}"
OutFile "${OUT}"
InstallDir "$LOCALAPPDATA\Programs\${NAME}"
InstallDirRegKey HKCU "${KEY}" "Folder"

VIProductVersion "${VERSION_DOTS}"
VIFileVersion "${VERSION_DOTS}"
VIAddVersionKey "ProductName" "${NAME}"
VIAddVersionKey "ProductVersion" "${VERSION}"
VIAddVersionKey "FileVersion" "${VERSION_DOTS}"
VIAddVersionKey "FileDescription" "Setup of ${NAME} ${VERSION}"
VIAddVersionKey "CompanyName" "${AUTHORS}"
VIAddVersionKey "LegalCopyright" "${COPYRIGHT}"

!ifdef SIGN
  !finalize '${SIGN} "%1"'
  !uninstfinalize '${SIGN} "%1"'
!endif

!include MUI2.nsh
!include LogicLib.nsh
!include FileFunc.nsh
!include WinVer.nsh

!define MUI_ICON "${ICON}"
!define MUI_UNICON "${ICON}"
!define MUI_WELCOMEFINISHPAGE_BITMAP "${SIDE_PICTURE}"
!define MUI_WELCOMEFINISHPAGE_BITMAP_STRETCH AspectFitHeight
!define MUI_ABORTWARNING
!define MUI_COMPONENTSPAGE_NODESC
!define MUI_FINISHPAGE_RUN "$INSTDIR\${EXECUTABLE}"
!define MUI_LICENSEPAGE_TEXT_BOTTOM "The libraries in ${NAME} have licences of their own: see the folder licences after \
the installation."
!define MUI_LICENSEPAGE_BUTTON "&Next >"

!insertmacro MUI_PAGE_LICENSE "${LICENCE_FILE}"
!insertmacro MUI_PAGE_COMPONENTS
!define MUI_PAGE_CUSTOMFUNCTION_LEAVE RefuseFolderWithOtherFiles
!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!insertmacro MUI_PAGE_FINISH
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE English

; The DLL that every window, command and helper process has open; Windows lets nobody else write to it meanwhile.
!macro WaitUntilClosed
  StrCpy $1 0
  ${Do}
    ${IfNot} ${FileExists} "$INSTDIR\${LIBRARY}"
      ${Break}
    ${EndIf}
    ClearErrors
    FileOpen $0 "$INSTDIR\${LIBRARY}" a
    ${IfNot} ${Errors}
      FileClose $0
      ${Break}
    ${EndIf}
    ${If} ${Silent}
      IntOp $1 $1 + 1
      ${If} $1 > ${SECONDS_TO_WAIT}
        SetErrorLevel 4
        Quit
      ${EndIf}
      Sleep 1000
    ${Else}
      MessageBox MB_RETRYCANCEL|MB_ICONEXCLAMATION "${NAME} is open, or its folder cannot be written to. Save your work \
and close it, then choose Retry." IDRETRY +3
      SetErrorLevel 4
      Quit
    ${EndIf}
  ${Loop}
!macroend

!macro RemoveShortcuts
  Delete "$SMPROGRAMS\${NAME}\${NAME}.lnk"
  Delete "$SMPROGRAMS\${NAME}\${NAME} commands.lnk"
  Delete "$SMPROGRAMS\${NAME}\Uninstall ${NAME}.lnk"
  RMDir "$SMPROGRAMS\${NAME}"
!macroend

!macro TellExplorer
  ; SHCNE_ASSOCCHANGED
  System::Call 'shell32::SHChangeNotify(i 0x8000000, i 0, p 0, p 0)'
!macroend

Section "${NAME}" SectionProgram
  SectionIn RO
  SetShellVarContext current
  Call RefuseFolderWithOtherFiles
  !insertmacro WaitUntilClosed

  ; One that lies elsewhere goes first.
  ReadRegStr $2 HKCU "${KEY}" "Folder"
  ${If} $2 != ""
  ${AndIf} $2 != $INSTDIR
  ${AndIf} ${FileExists} "$2\${UNINSTALLER}"
    ExecWait '"$2\${UNINSTALLER}" /S _?=$2' $0
    ${If} $0 != 0
      SetErrorLevel $0
      MessageBox MB_ICONSTOP "The ${NAME} in $2 could not be taken away. Close it, then try again." /SD IDOK
      Quit
    ${EndIf}
    Delete "$2\${UNINSTALLER}"
    RMDir "$2"
  ${EndIf}

  ; First of all, so that an installation that was broken off can be taken away or repeated.
  SetOutPath "$INSTDIR"
  WriteUninstaller "$INSTDIR\${UNINSTALLER}"
  RMDir /r "$INSTDIR\runtime.new"
  RMDir /r "$INSTDIR\runtime.old"

  ; The new files come beside the old ones and take their place at the end: what fails on the way leaves the old
  ; program working, and files that are no longer needed go.
  RMDir /r "$INSTDIR\commands"
  RMDir /r "$INSTDIR\licences"
  !include "${FILES}"
  SetOutPath "$INSTDIR"
  ClearErrors
  ${If} ${FileExists} "$INSTDIR\runtime\*.*"
    Rename "$INSTDIR\runtime" "$INSTDIR\runtime.old"
  ${EndIf}
  ${IfNot} ${Errors}
    Rename "$INSTDIR\runtime.new" "$INSTDIR\runtime"
  ${EndIf}
  ${If} ${Errors}
    RMDir /r "$INSTDIR\runtime.new"
    Rename "$INSTDIR\runtime.old" "$INSTDIR\runtime"
    SetErrorLevel 2
    MessageBox MB_ICONSTOP "The files of ${NAME} could not be put in their place. Close all programs that use $INSTDIR, \
then try again." /SD IDOK
    Quit
  ${EndIf}
  RMDir /r "$INSTDIR\runtime.old"

  CreateDirectory "$SMPROGRAMS\${NAME}"
  SetOutPath "$PROFILE"
  CreateShortcut "$SMPROGRAMS\${NAME}\${NAME}.lnk" "$INSTDIR\${EXECUTABLE}" "" "" 0 SW_SHOWNORMAL "" "${SUMMARY}"
  CreateShortcut "$SMPROGRAMS\${NAME}\${NAME} commands.lnk" "$SYSDIR\cmd.exe" \
    '/k ""$INSTDIR\commands\prompt.cmd""' "$INSTDIR\${EXECUTABLE}" 0 SW_SHOWNORMAL "" "A console for the commands"
  SetOutPath "$INSTDIR"
  CreateShortcut "$SMPROGRAMS\${NAME}\Uninstall ${NAME}.lnk" "$INSTDIR\${UNINSTALLER}"

  WriteRegStr HKCU "${CLASSES}\.${SUFFIX}" "" "${PROGID}"
  WriteRegStr HKCU "${CLASSES}\.${SUFFIX}" "Content Type" "${MIME_TYPE}"
  WriteRegStr HKCU "${CLASSES}\.${SUFFIX}\OpenWithProgids" "${PROGID}" ""
  WriteRegStr HKCU "${CLASSES}\${PROGID}" "" "${FILE_TYPE_NAME}"
  WriteRegStr HKCU "${CLASSES}\${PROGID}\DefaultIcon" "" '"$INSTDIR\${EXECUTABLE}",1'
  WriteRegStr HKCU "${CLASSES}\${PROGID}\shell\open\command" "" '"$INSTDIR\${EXECUTABLE}" "%1"'
  WriteRegStr HKCU "${CLASSES}\Applications\${EXECUTABLE}" "FriendlyAppName" "${NAME}"
  WriteRegStr HKCU "${CLASSES}\Applications\${EXECUTABLE}\SupportedTypes" ".${SUFFIX}" ""
  WriteRegStr HKCU "${CLASSES}\Applications\${EXECUTABLE}\shell\open\command" "" '"$INSTDIR\${EXECUTABLE}" "%1"'
  !insertmacro TellExplorer

  WriteRegStr HKCU "${KEY}" "Folder" "$INSTDIR"
  WriteRegStr HKCU "${APPS}" "DisplayName" "${NAME}"
  WriteRegStr HKCU "${APPS}" "DisplayVersion" "${VERSION}"
  WriteRegStr HKCU "${APPS}" "Publisher" "${AUTHORS}"
  WriteRegStr HKCU "${APPS}" "DisplayIcon" "$INSTDIR\${EXECUTABLE}"
  WriteRegStr HKCU "${APPS}" "InstallLocation" "$INSTDIR"
  WriteRegStr HKCU "${APPS}" "UninstallString" '"$INSTDIR\${UNINSTALLER}"'
  WriteRegStr HKCU "${APPS}" "QuietUninstallString" '"$INSTDIR\${UNINSTALLER}" /S'
  WriteRegDWORD HKCU "${APPS}" "EstimatedSize" ${SIZE_KB}
  WriteRegDWORD HKCU "${APPS}" "NoModify" 1
  WriteRegDWORD HKCU "${APPS}" "NoRepair" 1
SectionEnd

Section /o "Shortcut on the desktop" SectionDesktop
  SetShellVarContext current
  SetOutPath "$PROFILE"
  CreateShortcut "$DESKTOP\${NAME}.lnk" "$INSTDIR\${EXECUTABLE}" "" "" 0 SW_SHOWNORMAL "" "${SUMMARY}"
SectionEnd

Function .onInit
  ${IfNot} ${AtLeastWin10}
    MessageBox MB_ICONSTOP "${NAME} needs Windows 10 or newer." /SD IDOK
    SetErrorLevel 3
    Quit
  ${EndIf}
  SetShellVarContext current
  ${GetParameters} $0
  ClearErrors
  ${GetOptions} $0 "/DESKTOP" $1
  ${IfNot} ${Errors}
    !insertmacro SelectSection ${SectionDesktop}
  ${ElseIf} ${FileExists} "$DESKTOP\${NAME}.lnk"
    !insertmacro SelectSection ${SectionDesktop}
  ${EndIf}
FunctionEnd

; The uninstaller takes whole folders away: there must be nothing in them but the program.
Function RefuseFolderWithOtherFiles
  ${If} ${FileExists} "$INSTDIR\${UNINSTALLER}"
    Return
  ${EndIf}
  StrCpy $1 ""
  FindFirst $0 $1 "$INSTDIR\*.*"
  ${DoWhile} $1 != ""
    ${If} $1 != "."
    ${AndIf} $1 != ".."
      ${Break}
    ${EndIf}
    FindNext $0 $1
  ${Loop}
  FindClose $0
  ${If} $1 != ""
    MessageBox MB_ICONEXCLAMATION "There are other files in $INSTDIR. Choose an empty folder, or a new one." /SD IDOK
    SetErrorLevel 5
    ${If} ${Silent}
      Quit
    ${EndIf}
    Abort
  ${EndIf}
FunctionEnd

Section "Uninstall"
  SetShellVarContext current
  !insertmacro WaitUntilClosed
  ${IfNot} ${FileExists} "$INSTDIR\${UNINSTALLER}"
    SetErrorLevel 2
    Quit
  ${EndIf}
  RMDir /r "$INSTDIR\runtime"
  RMDir /r "$INSTDIR\runtime.new"
  RMDir /r "$INSTDIR\runtime.old"
  RMDir /r "$INSTDIR\commands"
  RMDir /r "$INSTDIR\licences"
  Delete "$INSTDIR\${EXECUTABLE}"
  Delete "$INSTDIR\${UNINSTALLER}"
  RMDir "$INSTDIR"

  !insertmacro RemoveShortcuts
  Delete "$DESKTOP\${NAME}.lnk"

  DeleteRegValue HKCU "${CLASSES}\.${SUFFIX}\OpenWithProgids" "${PROGID}"
  DeleteRegKey /ifempty HKCU "${CLASSES}\.${SUFFIX}\OpenWithProgids"
  ReadRegStr $0 HKCU "${CLASSES}\.${SUFFIX}" ""
  ${If} $0 == "${PROGID}"
    DeleteRegValue HKCU "${CLASSES}\.${SUFFIX}" ""
    DeleteRegValue HKCU "${CLASSES}\.${SUFFIX}" "Content Type"
  ${EndIf}
  DeleteRegKey /ifempty HKCU "${CLASSES}\.${SUFFIX}"
  DeleteRegKey HKCU "${CLASSES}\${PROGID}"
  DeleteRegKey HKCU "${CLASSES}\Applications\${EXECUTABLE}"
  !insertmacro TellExplorer
  DeleteRegKey HKCU "${APPS}"
  DeleteRegKey HKCU "${KEY}"
SectionEnd
